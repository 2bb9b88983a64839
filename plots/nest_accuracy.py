#!/usr/bin/python3
"""How far are sampled scales above exact ones, over the resolution of the samples?"""

import nestings
import records
import style
from style import plt


def figure(found, _published=None):
    runs = [run for run in records.with_results(found) if "accuracy" in run]
    if not runs:
        raise records.BadRecord("no comparison of sampled with exact scales among the records")
    fig, axes = plt.subplots(figsize=(6, 4.2))
    for i, run in enumerate(runs):
        errors = run["accuracy"]["errors"]
        colour = style.COLOURS[i % len(style.COLOURS)]
        for column, dashes, name in ((nestings.MEDIAN, style.LINES[0], "median"),
                                     (nestings.LARGEST, style.LINES[1], "largest")):
            axes.plot(errors[:, nestings.RESOLUTION], errors[:, column], color=colour, linestyle=dashes,
                      marker=style.MARKERS[i % len(style.MARKERS)], label=f"{run['shapes']}, {name}")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    ticks = sorted({int(n) for run in runs for n in run["accuracy"]["errors"][:, nestings.RESOLUTION]})
    axes.set_xticks(ticks, [str(n) for n in ticks])
    axes.set_xlabel("pixels along a side of a view")
    axes.set_ylabel("sampled scale less exact")
    axes.set_title("Sampling is optimistic")
    axes.legend(fontsize=8)
    bottom = style.caption(fig, records.provenance_line(runs) + ".")
    fig.tight_layout(rect=(0, bottom + 0.01, 1, 1))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "nest_accuracy", reader=nestings.read_folder))
