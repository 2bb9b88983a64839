#!/usr/bin/python3
"""What each setting takes and where it ends: seconds and objective, a row a setting, a marker a body."""

import numpy as np

import records
import style
from style import plt

LEAST = 1e-3  # per cent above the best; below, the axis is linear


def rows_of(groups):
    """Names of the settings, in the order in which they ran: union over the bodies."""
    names = {}
    for runs in groups.values():
        for fields in records.differences(runs):
            names.setdefault(records.setting_text(fields))
    return list(names)


def draw_pair(times, above, groups, rows, looks):
    """One formulation: a marker for each body in each row of both panels."""
    count = len(groups)
    for index, (body, runs) in enumerate(groups.items()):
        colour, marker = looks[body[0]]
        shift = (index - (count - 1) / 2) * 0.5 / max(count, 2)
        finals = [r["objective"] for r in runs if r["converged"]]
        for run, fields in zip(runs, records.differences(runs)):
            y = rows.index(records.setting_text(fields)) + shift
            good = run["converged"]
            look = dict(color=colour, marker=marker if good else "x", linestyle="none", markersize=5,
                        markerfacecolor=colour if good else "none")
            times.plot(run["seconds"], y, **look)
            if finals and good:
                above.plot((run["objective"] / min(finals) - 1) * 100, y, clip_on=False, zorder=3, **look)
    style.log_seconds(times)
    times.set_yticks(range(len(rows)), rows, fontsize=8)
    times.set_ylim(len(rows) - 0.4, -0.6)
    above.set_xscale("symlog", linthresh=LEAST)
    top = max(above.get_xlim()[1], 10 * LEAST)
    ticks = [0] + [10.0 ** k for k in range(-3, 4) if 10.0 ** k <= top]
    above.set_xticks(ticks, [f"{t:g}" for t in ticks])
    above.minorticks_off()
    above.set_xlim(0, top * 1.5)
    for axes in (times, above):
        for y in np.arange(0.5, len(rows) - 1):
            axes.axhline(y, color=style.GRID, linewidth=0.6, zorder=0)
        axes.grid(False, axis="y")
        axes.tick_params(axis="y", length=0)


def figure(found, _published=None):
    runs = records.solved(found, "objective")
    formulations = list(dict.fromkeys(run["formulation"] for run in runs))
    groups = [records.by_body([r for r in runs if r["formulation"] == f]) for f in formulations]
    rows = [rows_of(group) for group in groups]
    names = list(dict.fromkeys(body[0] for group in groups for body in group))
    looks = {name: (style.COLOURS[i % len(style.COLOURS)], style.MARKERS[i % len(style.MARKERS)])
             for i, name in enumerate(names)}
    heights = [len(r) * 0.22 + 0.75 for r in rows]
    fig, panels = plt.subplots(len(groups), 2, squeeze=False, sharey="row", height_ratios=heights,
                               figsize=(10, sum(heights) + 1.3))
    for (times, above), group, settings, name in zip(panels, groups, rows, formulations):
        draw_pair(times, above, group, settings, looks)
        grids = ", ".join(f"{body[0]} {body[1]}" for body in group)
        times.set_title(f"{'ray-rep' if name == 'rayrep' else name}: seconds of the solve", fontsize=9)
        above.set_title("objective above the best, %", fontsize=9)
        times.set_xlabel(grids, fontsize=7, color=style.QUIET, loc="left")
    for name, (colour, marker) in looks.items():
        panels[0, 0].plot([], [], color=colour, marker=marker, linestyle="none", markersize=5, label=name)
    panels[0, 0].plot([], [], color=style.QUIET, marker="x", linestyle="none", markersize=5,
                      label="did not converge")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    low = style.caption(fig, "Best: the lowest objective that a converged solve of that body and formulation "
                        f"reached. {records.provenance_line(runs)}.")
    fig.legend(handles, labels, loc="upper right", ncol=len(labels), fontsize=8)
    fig.tight_layout(rect=(0, low, 1, 1 - 0.3 / fig.get_figheight()))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "settings"))
