#!/usr/bin/python3
"""Which search nests largest? Scale over evaluations and over seconds: medians over the seeds, and their range."""

import numpy as np

import nestings
import records
import style
from style import plt


def median_line(runs, column):
    """A grid of `column`, and least, median and largest best scale of the runs there."""
    ends = [run["record"]["trace"][-1, column] for run in runs]
    starts = [max(run["record"]["trace"][0, column], 1e-3) for run in runs]
    grid = np.geomspace(max(starts), np.median(ends), 80)
    bests = []
    for run in runs:
        at = np.searchsorted(run["record"]["trace"][:, column], grid, side="right") - 1
        best = run["record"]["trace"][np.maximum(at, 0), nestings.BEST]
        bests.append(np.where(np.isfinite(best), best, 0))
    return grid, np.min(bests, axis=0), np.median(bests, axis=0), np.max(bests, axis=0)


def figure(found, _published=None):
    runs = nestings.searched(found)
    names = nestings.settings(runs)
    settings = list(dict.fromkeys(names))
    groups = nestings.by_shapes(runs)
    name_of = {id(run): name for run, name in zip(runs, names)}
    fig, grid = plt.subplots(len(groups), 2, squeeze=False, sharey="row", figsize=(10, 3.4 * len(groups) + 1.4))
    handles = {}
    for row, (shapes, members) in zip(grid, groups.items()):
        for axes, column, label in ((row[0], nestings.EVALUATIONS, "placements asked for"),
                                    (row[1], nestings.SECONDS, "seconds of search")):
            for i, setting in enumerate(settings):
                seeds = [run for run in members if name_of[id(run)] == setting]
                if not seeds:
                    continue
                x, low, middle, high = median_line(seeds, column)
                colour = style.COLOURS[i % len(style.COLOURS)]
                dashes = style.LINES[i // len(style.COLOURS) % len(style.LINES)]
                handles[setting], = axes.plot(x, middle, color=colour, linestyle=dashes, linewidth=1.4)
                axes.fill_between(x, low, high, color=colour, alpha=0.06, linewidth=0)
            axes.set_xscale("log")
            axes.set_xlabel(label)
        row[0].set_ylabel("largest scale found")
        row[0].set_title(shapes)
    fig.legend(handles.values(), handles, fontsize=7, ncols=3, loc="upper center", bbox_to_anchor=(0.5, 1.0))
    bottom = style.caption(fig, "Medians over the seeds; shaded: from the least to the largest. "
                           + records.provenance_line(runs) + ".")
    lines = -(-len(handles) // 3)
    fig.tight_layout(rect=(0, bottom + 0.01, 1, 1 - (0.15 * lines + 0.1) / fig.get_figheight()))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "nest_variants", reader=nestings.read_folder))
