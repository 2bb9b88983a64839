#!/usr/bin/python3
"""What does each formulation reach, in what time? Objective above the best of the same columns against seconds.

A panel a body, a line a formulation. Every grid has columns of its own, so objectives of two grids differ by more than
those of two formulations: each is set beside the lowest on its grid.
"""

import collections

import records
import style
from style import plt

# Formulation, Hessian and linear solver: a name, a colour, a marker. Only the ray-rep is drawn with both Hessians.
LOOKS = {
    "quadric": ("one quadric", style.COLOURS[2], "D"),
    "rayrep": ("ray-rep, lifted exact Hessian", style.BLUE, "o"),
    "rayrep, limited-memory": ("ray-rep, L-BFGS", style.COLOURS[5], "^"),
    "octree": ("octree", style.COLOURS[4], "v"),
    "voxel": ("voxels", style.VERMILION, "s"),
    "rayrep, mumps": ("ray-rep, MUMPS", style.BLUE, "o"),
    "voxel, mumps": ("voxels, MUMPS", style.VERMILION, "s"),
}
MUMPS = ", mumps"  # the same iterates as without it, so only the time differs


def way(run):
    if run["config"].get("ipopt.linear_solver") == "mumps":
        return run["formulation"] + MUMPS
    if run["formulation"] == "rayrep" and run["config"].get("ipopt.hessian_approximation") == "limited-memory":
        return "rayrep, limited-memory"
    return run["formulation"]


def by_way(found):
    """{model: {key of LOOKS: converged runs, coarse to fine}}, and how many runs were left out."""
    runs = records.solved(found, "objective", "rays")
    lines = collections.defaultdict(lambda: collections.defaultdict(list))
    left_out = 0
    for run in runs:
        if not run["converged"]:
            left_out += 1
            continue
        lines[run["model"]][way(run)].append(run)
    for ways in lines.values():
        for line in ways.values():
            line.sort(key=lambda run: run["rays"])
    if not lines:
        raise records.BadRecord("no converged run")
    return lines, left_out


def panels_for(count, height=3.0):
    """A figure of `count` panels, three across, and the panels; those over are hidden."""
    across = min(count, 3)
    down = -(-count // across)
    fig, grid = plt.subplots(down, across, squeeze=False, figsize=(3.5 * across + 0.6, height * down + 1.1))
    for axes in list(grid.flat)[count:]:
        axes.set_visible(False)
    return fig, list(grid.flat)[:count]


def legend_of(fig, panels):
    handles = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    order = [name for name, _, _ in LOOKS.values() if name in handles]
    order += [name for name in handles if name not in order]
    fig.legend([handles[name] for name in order], order, loc="upper right", ncols=len(order), fontsize=8)


def finish(fig, panels, note, runs, left_out):
    legend_of(fig, panels)
    note += f" {records.provenance_line(runs)}."
    if left_out:
        note += f" Left out for want of convergence: {left_out} of {left_out + len(runs)} runs."
    low = style.caption(fig, note)
    fig.tight_layout(rect=(0, low, 1, 1 - 0.3 / fig.get_figheight()))
    return fig


def draw_panel(axes, model, ways):
    best = {}
    for run in (run for line in ways.values() for run in line):
        best[run["grid"]] = min(best.get(run["grid"], run["objective"]), run["objective"])
    axes.set_title(model)
    for key, line in sorted(ways.items(), key=lambda item: list(LOOKS).index(item[0])):
        name, colour, marker = LOOKS[key]
        x = [run["seconds"] for run in line]
        y = [(run["objective"] / best[run["grid"]] - 1) * 100 for run in line]
        axes.plot(x, y, color=colour, marker=marker, markersize=4.5, linewidth=1.3, label=name)
        below = key == "quadric"  # these lie at zero, close together
        for row, (run, at_x, at_y) in enumerate(sorted(zip(line, x, y), key=lambda point: point[1])):
            axes.annotate(max(map(int, run["grid"].split("×"))), (at_x, at_y), textcoords="offset points", fontsize=6.5,
                          xytext=(0, 5 + 7 * (row % 3)) if below else (3, 4), color=colour,
                          ha="center" if below else "left")
    axes.set_xscale("log")
    axes.set_ylim(bottom=-0.04 * axes.get_ylim()[1])
    axes.set_xlabel("seconds of the solve")


def figure(found, _published=None):
    lines, left_out = by_way(found)
    for ways in lines.values():
        for key in [key for key in ways if key.endswith(MUMPS)]:
            del ways[key]
    fig, panels = panels_for(len(lines))
    for axes, (model, ways) in zip(panels, lines.items()):
        draw_panel(axes, model, ways)
    panels[0].set_ylabel("objective above the best of its columns, %")
    runs = [run for ways in lines.values() for line in ways.values() for run in line]
    return finish(fig, panels, "Lower and further left is better; numbers are cells along the longest side. Median seconds of the solve, "
                  "set-up excluded.", runs,
                  left_out)


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "formulations"))
