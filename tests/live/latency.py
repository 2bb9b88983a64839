"""From what somebody does to its numbers, in a browser: latency.py DESIGN [MODEL [SAMPLES]]. Medians, in milliseconds: until they
are written into the page, and until the browser has drawn them, which is also what else it draws at that time."""

import statistics
import sys
import time

from browser import Browser
from live import Live

program, model, samples = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "bunny", int(sys.argv[3]) if len(sys.argv) > 3 else 200

# What a hand does, one event after the answer to the one before: the k-th, from 0 to 1.
moves = {
    "draft": ("float", "kreisel.set('problem.draft', `${(40 + 20 * k).toFixed(3)}%`, true)"),
    "density": ("spin", "kreisel.set('density', (1 + k).toFixed(4), true)"),
    "axis": ("spin", "kreisel.set('axis', `${(0.1 * Math.sin(6 * k)).toFixed(4)},${(0.1 * Math.cos(6 * k)).toFixed(4)},1`, true)"),
    "contact": ("spin", "kreisel.set('contact', kreisel.answer.contact.map((v, i) => v + 0.01 * Math.sin(9 * k + i)).join(','), true)"),
    "wall": ("spin", "kreisel.set('wall', (1.2 + k).toFixed(4), true)"),
}


def tell(name, taken):
    written, drawn = (statistics.median(t[key] for t in taken) for key in ("written", "ms"))
    late = sorted(t["ms"] for t in taken)[int(0.9 * len(taken))]
    print(f"{name}: written {written:.1f} ms, drawn {drawn:.1f} ms (medians of {len(taken)}), 9 of 10 drawn within {late:.1f}")


with Live(program, model, "--resolution", "96") as live, Browser(live.url, 900 + 640, 700 + 50) as browser:
    browser.until("window.kreisel && kreisel.answer", 300)
    print(f"first answer after {browser.js('kreisel.firstAnswer'):.0f} ms of the page, in a browser that starts")
    time.sleep(5)
    browser.js("window.before = true; location.reload(); 1")
    browser.until("!window.before && window.kreisel && kreisel.firstAnswer", 300)
    print(f"first answer after {browser.js('kreisel.firstAnswer'):.0f} ms of the page, in one that runs")
    time.sleep(5)
    browser.until("kreisel.scene.walls.visible", 300)
    frames = []
    for _ in range(10):
        browser.js("kreisel.scene.frameMs = 0; kreisel.scene.redraw(); 1")
        browser.until("kreisel.scene.frameMs > 0")
        frames.append(browser.js("kreisel.scene.frameMs"))
    print(f"a frame of {browser.js('kreisel.scene.canvas.width')} x {browser.js('kreisel.scene.canvas.height')}: {statistics.median(frames):.0f} ms, three passes")
    problem = ""
    for name, (asked, move) in moves.items():
        if asked != problem:
            browser.js(f"kreisel.setAll({{problem: '{asked}'}})")
            browser.until(f"kreisel.answer && kreisel.answer.problem === '{asked}' && !kreisel.answer.moving")
            time.sleep(3)
            problem = asked
        count = samples if name != "wall" else samples // 4
        taken = browser.js(f"""(async () => {{
            const taken = [];
            for (let i = 0; i < {count}; ++i) {{
              const k = i / {count}, before = kreisel.times.length;
              {move};
              while (kreisel.times.length === before) await new Promise(done => setTimeout(done, 1));
              taken.push(kreisel.times[kreisel.times.length - 1]);
            }}
            return taken;
          }})()""")
        tell(name, taken)
    rest = browser.js("""(async () => {
        const before = kreisel.times.length;
        kreisel.set('wall', '1.7', false);
        while (kreisel.times.length === before) await new Promise(done => setTimeout(done, 1));
        return kreisel.times[kreisel.times.length - 1].ms; })()""")
    print(f"wall at rest: {rest:.0f} ms")
    browser.js("kreisel.setAll({problem: 'nest'})")
    browser.until("kreisel.nest.answer", 120)
    taken = browser.js(f"""(async () => {{
        const taken = [], nest = kreisel.nest, times = kreisel.nestTimes, start = nest.field.centroid.split(',').map(Number);
        for (let i = 0; i < {samples}; ++i) {{
          const before = times.length;
          nest.field = {{...nest.field, centroid: start.map((v, k) => v + Math.sin(i / 9 + k)).join(',')}};
          nest.ask(true);
          while (times.length === before) await new Promise(done => setTimeout(done, 1));
          taken.push(times[times.length - 1]);
        }}
        return taken;
      }})()""")
    tell("nesting", taken)
