#!/usr/bin/python3
"""How much faster is the ray-rep than voxels? One panel a model, one line a Hessian, published ratios hollow.

A pair is two converged runs whose configurations differ in the formulation and, at most, in solver settings other
than the Hessian: each side may have the settings that suit it best.
"""

import argparse
import collections
import sys

import records
import style
from style import plt

SETTINGS = {
    "exact": ("exact Hessian, lifted", style.BLUE, "o"),
    "limited-memory": ("L-BFGS", style.VERMILION, "s"),
}
SECONDS = ("setup", "kernels", "solve", "total")  # columns of solve/samples
PUBLISHED = "rayrep_table2"

Point = collections.namedtuple("Point", "cells ratio low high grid")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="folder of records (*.h5), searched with its sub-folders")
    parser.add_argument("-o", "--output", default="speedup.png", help="PNG to write (default %(default)s)")
    parser.add_argument("--seconds", choices=("solve", "total"), default="solve",
                        help="compare the solve alone, or with its set-up (default %(default)s)")
    parser.add_argument("--device", help="part of a device's name, where the folder holds several")
    parser.add_argument("--published", default=PUBLISHED, help="published ratios: name or JSON file "
                        "(default %(default)s)")
    return parser.parse_args()


def usable(found, device):
    """Converged runs of the two formulations on one device, and how many others were left out."""
    runs = [r for r in records.solves(found, "seconds.solve", "seconds.total", "samples")
            if r["formulation"] in ("rayrep", "voxel")]
    if device:
        runs = [r for r in runs if device.lower() in r["provenance"]["device"].lower()]
    kept = [r for r in runs if r["converged"]]
    devices = sorted({r["provenance"]["device"] for r in kept})
    if len(devices) > 1:
        raise records.BadRecord(f"records of several devices ({', '.join(devices)}), expected --device NAME")
    return kept, len(runs) - len(kept)


def cells_of(run):
    return tuple(map(int, run["grid"].split("×")))


def problem_of(run):
    """Everything that a pair has in common."""
    own = {k: v for k, v in run["config"].items() if k != "formulation" and "." not in k}
    own["hessian"] = run["config"].get("ipopt.hessian_approximation", "exact")
    return tuple(sorted(own.items())), cells_of(run)


def preferred(runs):
    """Of runs that differ in the formulation's own settings: as few of those as can be, then the newest."""
    def rank(run):
        return (-sum(k.startswith("formulation.") for k in run["config"]), run["provenance"]["started"])
    return max(runs, key=rank)


def point(rayrep, voxel, which):
    column = SECONDS.index(which)
    fast, slow = (r["record"]["solve"]["samples"][:, column] for r in (rayrep, voxel))
    median = voxel[f"seconds.{which}"] / rayrep[f"seconds.{which}"]
    grid = cells_of(rayrep)
    return Point(max(grid), median, slow.min() / fast.max(), slow.max() / fast.min(), grid)


def series(runs, which):
    """{model: {Hessian: points by resolution}}, and the runs they use."""
    together = collections.defaultdict(lambda: collections.defaultdict(list))
    for run in runs:
        together[problem_of(run)][run["formulation"]].append(run)
    newest, used = {}, []
    for pair in together.values():
        if len(pair) < 2:
            continue
        rayrep, voxel = preferred(pair["rayrep"]), preferred(pair["voxel"])
        hessian = rayrep["config"].get("ipopt.hessian_approximation", "exact")
        key = rayrep["model"], hessian, cells_of(rayrep)
        started = rayrep["provenance"]["started"]
        if key in newest:
            print(f"speedup.py: several pairs for {key[0]} {key[2]} {hessian}; the newest is drawn",
                  file=sys.stderr)
        if key not in newest or started > newest[key][0]:
            newest[key] = started, rayrep, voxel
    lines = collections.defaultdict(lambda: collections.defaultdict(list))
    for (model, hessian, _), (_, rayrep, voxel) in newest.items():
        lines[model][hessian].append(point(rayrep, voxel, which))
        used += [rayrep, voxel]
    for hessians in lines.values():
        for points in hessians.values():
            points.sort()
    return lines, used


def published_ratios(path):
    """Where they come from, and {model: [(cells along the longest side, ratio)]}."""
    source, all_rows = records.read_published(path)
    rows = collections.defaultdict(list)
    for row in all_rows:
        if "speedup" in row:
            rows[row["model"]].append((max(row["grid"]), row["speedup"]))
    return source, {model: sorted(points) for model, points in rows.items()}


def draw_panel(axes, model, hessians, published):
    axes.set_title(model)
    axes.axhline(1, color=style.QUIET, linewidth=0.8)
    for hessian, points in sorted(hessians.items()):
        label, colour, marker = SETTINGS.get(hessian, (hessian, style.QUIET, "^"))
        x, y = [p.cells for p in points], [p.ratio for p in points]
        spread = [[p.ratio - p.low for p in points], [p.high - p.ratio for p in points]]
        axes.errorbar(x, y, yerr=spread, color=colour, marker=marker, markersize=5, linewidth=1.6,
                      elinewidth=0.9, capsize=2.5, label=label)
    if published:
        axes.plot(*zip(*published), linestyle="none", marker="D", markersize=6, markerfacecolor="none",
                  markeredgecolor=style.INK, markeredgewidth=1.1, label="published")
    cells = sorted({p.cells for points in hessians.values() for p in points} | {x for x, _ in published})
    axes.set_xticks(cells)
    margin = 0.12 * (cells[-1] - cells[0]) or 4
    axes.set_xlim(cells[0] - margin, cells[-1] + margin)
    axes.set_xlabel("cells along the longest side")


def ratio_ticks(axes):
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    ticks = [t for t in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if low <= t <= high]
    axes.set_yticks(ticks)
    axes.set_yticklabels([f"{t:g}×" for t in ticks])
    axes.minorticks_off()


def draw(lines, source, published, note):
    models = sorted(lines)
    across = min(len(models), 3)
    down = -(-len(models) // across)
    figure, panels = plt.subplots(down, across, sharey=True, squeeze=False,
                                  figsize=(max(3.4 * across + 0.6, 5), 3.1 * down + 1.2))
    for axes, model in zip(panels.flat, models):
        draw_panel(axes, model, lines[model], published.get(model, []))
    ratio_ticks(panels[0, 0])
    for axes in list(panels.flat)[len(models):]:
        axes.set_visible(False)
    for row in panels:
        row[0].set_ylabel("speed-up, ray-rep over voxel")
    handles = {}
    for axes in panels.flat:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    if "published" in handles:  # last, after what is measured here
        handles["published"] = handles.pop("published")
    figure.legend(handles.values(), handles.keys(), loc="upper right", ncol=3, fontsize=8)
    if any(published.get(model) for model in models):
        note += f" Published: {source}."
    bottom = style.caption(figure, note)
    figure.tight_layout(rect=(0, bottom, 1, 1 - 0.3 / figure.get_figheight()))
    return figure


def figure(found, published, device=None, which="solve"):
    """@throws BadRecord  no pair of converged runs, or records of several devices and none asked for."""
    runs, left_out = usable(found, device)
    lines, used = series(runs, which)
    if not lines:
        raise records.BadRecord("no two converged runs that differ in the formulation alone")
    source, ratios = published_ratios(published)
    repeats = sorted({r["samples"] for r in used})
    times = "solve" if which == "solve" else "set-up and solve"
    span = f"{repeats[0]} to {repeats[-1]}" if len(repeats) > 1 else str(repeats[0])
    note = (f"Median seconds of the {times}, voxel over ray-rep, {span} timed solves each; bars span the "
            f"ratios of single solves. {records.provenance_line(used)}.")
    if left_out:
        note += f" Left out for want of convergence: {left_out} of {left_out + len(runs)} runs."
    return draw(lines, source, ratios, note)


def main():
    args = arguments()
    path = args.published if args.published.endswith(".json") else records.published_path(args.published)
    records.save(figure(records.read_folder(args.folder), path, args.device, args.seconds), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
