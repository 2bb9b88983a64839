#!/usr/bin/python3
"""What does a thicker wall cost? Objective, and whether the part does what was asked, against the wall."""

import collections
import operator

import records
import style
from style import plt


def series(runs, against):
    """{model: runs by what they are drawn against}."""
    lines = collections.defaultdict(list)
    for run in runs:
        lines[run["model"]].append(run)
    for line in lines.values():
        line.sort(key=against)
    return lines


RATIO = "verified.largest_over_lateral"


def draw_line(upper, lower, model, line, colour, marker, against):
    met = [run for run in line if run["converged"]]
    upper.plot([against(r) for r in met], [r["objective"] for r in met], color=colour, linewidth=1.4, zorder=2)
    upper.axhline(met[0]["solid_objective"], color=colour, linewidth=0.9, linestyle=style.LINES[2], zorder=1)
    ratios = [run for run in met if run[RATIO] is not None]
    lower.plot([against(r) for r in ratios], [r[RATIO] for r in ratios], color=colour, linewidth=1.4, zorder=2)
    for run in line:
        x, good = against(run), run["converged"] and run["verified"]
        look = dict(color=colour, linestyle="none", markersize=5, marker=marker if run["converged"] else "x",
                    markerfacecolor=colour if good else "white", zorder=3)
        if run["converged"]:
            upper.plot(x, run["objective"], **look)
            if run in ratios:
                lower.plot(x, run[RATIO], **look)
        else:
            upper.plot(x, met[-1]["objective"], **look)
    upper.plot([], [], color=colour, marker=marker, markersize=5, label=model)


def sweep(found, column, label, left=0, scale="linear"):
    """Objective (its axis of this scale), and the ratio of moments of what spins, against a column of the runs."""
    against = operator.itemgetter(column)
    runs = records.solved(found, column, "objective", "solid_objective", "verified", "domain", RATIO)
    lines = {model: line for model, line in series(runs, against).items() if any(r["converged"] for r in line)}
    if not lines:
        raise records.BadRecord("no converged run")
    fig, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(7, 6.2), height_ratios=(3, 2))
    for (model, line), colour, marker in zip(lines.items(), style.COLOURS, style.MARKERS):
        draw_line(upper, lower, model, line, colour, marker, against)
    upper.plot([], [], color=style.QUIET, linestyle=style.LINES[2], linewidth=0.9, label="the solid")
    for look, meaning in ((dict(marker="o", markerfacecolor="white"), "misses the verdict"),
                        (dict(marker="x"), "infeasible")):
        if meaning == "infeasible" and all(r["converged"] for r in runs):
            continue
        if meaning != "infeasible" and all(r["verified"] for r in runs if r["converged"]):
            continue
        upper.plot([], [], color=style.QUIET, linestyle="none", markersize=5, label=meaning, **look)
    lower.axhline(1, color=style.INK, linewidth=0.8)
    upper.set_title("objective")
    lower.set_title("Izz over the next principal moment; below 1 it does not spin")
    lower.set_xlabel(label)
    upper.set_xlim(left=left)
    upper.set_yscale(scale)
    upper.legend(fontsize=8, ncols=2)
    sizes = ", ".join(f"{m} {line[0]['grid']}" for m, line in lines.items())
    kinds = ", ".join(sorted({run["domain"] for run in runs}))
    low = style.caption(fig, f"{kinds} domain; {sizes}. {records.provenance_line(runs)}.", 105)
    fig.tight_layout(rect=(0, low, 1, 1))
    return fig


def figure(found, _published=None):
    return sweep(found, "wall", "least wall, mm")


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "walls"))
