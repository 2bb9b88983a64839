#!/usr/bin/python3
"""How a solve gets there: objective and violation over the iterations, one column a body, one line a setting."""

import matplotlib.ticker
import numpy as np

import records
import style
from style import plt

ITERATION, OBJECTIVE, VIOLATION = range(3)  # columns of solve/history
LEAST = 1e-12  # violations below are drawn there: the axis is logarithmic


def varied(fields):
    """The fields that differ, the one with the most values first, each with its values."""
    values = {n: list(dict.fromkeys(one.get(n, "default") for one in fields)) for one in fields for n in one}
    return dict(sorted(values.items(), key=lambda item: -len(item[1])))


def looks(fields):
    """(colour, dashes, names in the legend) of each run, and the legend {name: look of a line}.

    With two fields one gives the colour, the other the dashes; else every run is an entry of its own.
    """
    values = varied(fields)
    legend, chosen = {}, []
    if len(values) == 2 and len(list(values.values())[1]) <= len(style.LINES):
        (first, colours), (second, dashes) = values.items()
        for i, value in enumerate(colours):
            legend[f"{first} = {value}"] = dict(color=style.COLOURS[i % len(style.COLOURS)])
        for i, value in enumerate(dashes):
            legend[f"{second} = {value}"] = dict(color=style.QUIET, linestyle=style.LINES[i])
        for one in fields:
            colour = style.COLOURS[colours.index(one.get(first, "default")) % len(style.COLOURS)]
            chosen.append((colour, style.LINES[dashes.index(one.get(second, "default"))]))
        return chosen, legend
    for i, one in enumerate(fields):
        colour, dashes = style.COLOURS[i % len(style.COLOURS)], style.LINES[i // len(style.COLOURS) % 4]
        chosen.append((colour, dashes))
        legend[records.setting_text(one)] = dict(color=colour, linestyle=dashes)
    return chosen, legend


def draw_column(top, bottom, runs, legend):
    chosen, entries = looks(records.differences(runs))
    legend.update({name: look for name, look in entries.items() if name not in legend})
    finals = [run["objective"] for run in runs if run["converged"]]
    for run, (colour, dashes) in zip(runs, chosen):
        history = run["record"]["solve"]["history"]
        top.plot(history[:, ITERATION], history[:, OBJECTIVE], color=colour, linestyle=dashes, linewidth=1.4)
        top.plot(history[-1, ITERATION], run["objective"], marker="o" if run["converged"] else "x",
                 color=colour, markersize=5, clip_on=False, zorder=4)
        bottom.plot(history[:, ITERATION], np.maximum(history[:, VIOLATION], LEAST), color=colour,
                    linestyle=dashes, linewidth=1.2)
    if finals:
        # Objectives may come from far off, from a start that is infeasible: what counts is near the end.
        low, high = min(finals), max(finals)
        reach = max(0.25 * abs(low), 1.5 * (high - low))
        top.set_ylim(low - 0.2 * reach, low + reach)
        top.axhline(low, color=style.QUIET, linewidth=0.8, zorder=0)
    top.set_title(f"{runs[0]['model']} {runs[0]['grid']}, {runs[0]['problem']}")
    bottom.set_yscale("log")
    bottom.yaxis.set_major_locator(matplotlib.ticker.LogLocator(numticks=6))
    bottom.minorticks_off()
    bottom.set_xlabel("iteration")


def figure(found, _published=None):
    runs = [run for run in records.solved(found, "objective") if len(run["record"]["solve"]["history"])]
    groups = list(records.by_body(runs, "formulation").values())
    if not groups:
        raise records.BadRecord("no record with a history of iterations")
    across = len(groups)
    # A body may take ten times the iterations of another: each column has an axis of its own.
    fig, panels = plt.subplots(2, across, squeeze=False, sharex="col", height_ratios=(2, 1.1),
                               figsize=(max(3.3 * across + 0.6, 6), 5.6))
    legend = {}
    for column, group in enumerate(groups):
        draw_column(panels[0, column], panels[1, column], group, legend)
    panels[0, 0].set_ylabel("objective")
    panels[1, 0].set_ylabel("largest violation")
    note = ("Circle: where the solve ended; cross: it did not converge. Iterates that violate the constraints may lie "
            "below the minimum (grey line). Violations under 1e-12 are drawn there. "
            f"{records.provenance_line(runs)}.")
    low = style.caption(fig, note)
    handles = [panels[0, 0].plot([], [], linewidth=1.6, label=name, **look)[0] for name, look in legend.items()]
    columns = max(1, int(fig.get_figwidth() * 13 / (max(map(len, legend)) + 8)))
    rows = -(-len(handles) // columns)
    fig.legend(handles=handles, loc="upper left", ncol=columns, fontsize=8)
    fig.tight_layout(rect=(0, low, 1, 1 - (0.15 + 0.18 * rows) / fig.get_figheight()))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "history"))
