#!/usr/bin/python3
"""The inertia tensor before and after hollowing, in units of the body's own Izz before; published beside it."""

import numpy as np

import records
import style
from style import plt

NAMES = ("Ixx", "Iyy", "Izz", "Ixy", "Iyz", "Ixz")


def six(moments):
    """Ixx Iyy Izz Ixy Iyz Ixz about the centre of mass, from ten moments."""
    s1, sx, sy, sz, sxy, syz, sxz, sxx, syy, szz = moments
    cxx, cyy, czz = sxx - sx * sx / s1, syy - sy * sy / s1, szz - sz * sz / s1
    return np.array([cyy + czz, cxx + czz, cxx + cyy, -(sxy - sx * sy / s1), -(syz - sy * sz / s1),
                     -(sxz - sx * sz / s1)])


def series_of(run):
    """{label: (six numbers, look)}"""
    before = six(run["solid_moments_body"])
    scale = before[2]
    bars = {"solid": (before / scale, dict(color=style.COLOURS[5])),
            "hollowed": (six(run["moments_body"]) / scale, dict(color=style.BLUE))}
    if run["published.inertia"]:
        there = {k: np.array(run["published.inertia"][k]) for k in ("before", "after")}
        look = dict(facecolor="none", edgecolor=style.INK, linewidth=0.9)
        bars["published, before"] = (there["before"] / there["before"][2], dict(look, hatch="...."))
        bars["published, after"] = (there["after"] / there["before"][2], dict(look, hatch="////"))
    return bars


def draw_panel(axes, run, title):
    bars = series_of(run)
    width = 0.8 / len(bars)
    for index, (label, (values, look)) in enumerate(bars.items()):
        axes.bar(np.arange(6) + (index - (len(bars) - 1) / 2) * width, values, width * 0.9, label=label, **look)
    axes.axhline(0, color=style.QUIET, linewidth=0.8)
    axes.axvline(2.5, color=style.GRID, linewidth=1)
    axes.set_xticks(range(6), NAMES)
    axes.tick_params(axis="x", length=0)
    axes.grid(False, axis="x")
    axes.set_title(title)


def figure(found, published=None):
    runs = records.solved(found, "solid_moments_body", "moments_body", "published.inertia", published=published)
    source, printed = records.read_published(published) if published else ("", [])
    titled = []
    for group in records.by_body(runs, "formulation").values():
        for run, fields in zip(group, records.differences(group)):
            own = f", {records.setting_text(fields)}" if fields else ""
            titled.append((run, f"{run['model']} {run['grid']}, {run['formulation']}{own}"))
    across = min(len(titled), 2)
    down = -(-len(titled) // across)
    fig, panels = plt.subplots(down, across, squeeze=False, sharey=True,
                               figsize=(5.2 * across + 0.4, 3.1 * down + 1.0))
    for axes, (run, title) in zip(panels.flat, titled):
        draw_panel(axes, run, title)
    for axes in list(panels.flat)[len(titled):]:
        axes.set_visible(False)
    for row in panels:
        row[0].set_ylabel("relative to Izz of the solid")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    note = ("About the centre of mass, axes of the body frame, z the spin axis; Ixy, Iyz, Ixz: elements of the tensor. "
            f"{records.provenance_line(runs)}.")
    if printed:
        note += f" Published: {source}; another mesh, unit and sign of the products not stated."
    low = style.caption(fig, note)
    fig.legend(handles, labels, loc="upper right", ncol=len(labels), fontsize=8)
    fig.tight_layout(rect=(0, low, 1, 1 - 0.3 / fig.get_figheight()))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "inertia", "rayrep_bird"))
