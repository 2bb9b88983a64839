#!/usr/bin/python3
"""How far above the best interior of the same columns do ray-reps end? A row a body, a marker a kind of bounds."""

import numpy as np

import records
import style
from style import plt

LOOKS = {"midpoint": (style.VERMILION, "o"), "ordered": (style.BLUE, "s")}
LEAST = 0.01  # per cent; below, the axis is linear


def above(run, best):
    return (run["objective"] / best["objective"] - 1) * 100


def figure(found, _published=None):
    runs = [run for run in records.solved(found, "objective", "gap_percent", "domain") if run["domain"] == "columns"]
    rows = []
    for body, members in records.by_body(runs).items():
        best = [run for run in members if run["formulation"] == "quadric" and run["converged"]]
        if best:
            rows.append((body, best[0], [run for run in members if run["formulation"] == "rayrep"]))
    if not rows:
        raise records.BadRecord("no converged quadric to compare with")
    fig, axes = plt.subplots(figsize=(7.5, 0.42 * len(rows) + 1.9))
    for y, (_, best, others) in enumerate(rows):
        gap = np.nan if best["gap_percent"] is None else best["gap_percent"]
        axes.barh(y, gap, height=0.5, left=-gap, color=style.VOID, edgecolor=style.QUIET, linewidth=0.5, zorder=1)
        for run in others:
            kind = run["config"].get("formulation.bounds", "midpoint")
            colour, marker = LOOKS[kind]
            good = run["converged"]
            x = above(run, best)
            axes.plot(x, y, color=colour, marker=marker if good else "x", linestyle="none", markersize=7,
                      markerfacecolor=colour if kind == "midpoint" else "none", zorder=3)
            place = dict(xytext=(0, 7), ha="center") if kind == "midpoint" else dict(xytext=(7, -2.5), ha="left")
            axes.annotate(f"{x:.2g} %" + ("" if good else ", not converged"), (x, y), textcoords="offset points",
                          fontsize=7, color=colour, **place)
    axes.set_yticks(range(len(rows)), [f"{best['model']} {best['grid']}" for _, best, _ in rows])
    axes.set_ylim(len(rows) - 0.4, -0.75)
    axes.set_xscale("symlog", linthresh=LEAST)
    low, high = axes.get_xlim()
    tens = [10.0 ** k for k in range(-2, 4)]
    ticks = [-t for t in tens if -t >= low][::-1] + [0] + [t for t in tens if t <= high]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.minorticks_off()
    axes.axvline(0, color=style.INK, linewidth=0.8)
    axes.grid(False, axis="y")
    axes.set_xlabel("objective above the quadric's, %")
    for kind, (colour, marker) in LOOKS.items():
        axes.plot([], [], color=colour, marker=marker, linestyle="none",
                  markerfacecolor=colour if kind == "midpoint" else "none", label=f"ray-rep, {kind} bounds")
    axes.barh([0], [0], color=style.VOID, edgecolor=style.QUIET, linewidth=0.5,
              label="certified: the least is not below")
    used = [run for _, best, others in rows for run in (best, *others)]
    low = style.caption(fig, f"0: one quadric on the same columns. {records.provenance_line(used)}.")
    fig.legend(loc="upper right", ncols=3, fontsize=8)
    fig.tight_layout(rect=(0, low, 1, 1 - 0.3 / fig.get_figheight()))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "bounds"))
