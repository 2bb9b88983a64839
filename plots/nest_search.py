#!/usr/bin/python3
"""How a search for the largest nesting gets there: scale over seconds, a line a run."""

import nestings
import records
import style
from style import plt


def figure(found, _published=None):
    runs = nestings.searched(found)
    groups = nestings.by_shapes(runs)
    several = len(groups) > 1
    # What differs among the searches of the same shapes.
    names = {id(run): name for members in groups.values() for run, name in zip(members, nestings.settings(members))}
    fig, axes = plt.subplots(figsize=(8, 4.6))
    for i, run in enumerate(runs):
        trace = run["record"]["trace"]
        alone = len(groups[run["shapes"]]) == 1
        label = ", ".join(([run["shapes"]] if several or alone else []) + ([] if alone else [names[id(run)]]))
        line, = axes.plot(trace[:, nestings.SECONDS], trace[:, nestings.BEST],
                          color=style.COLOURS[i % len(style.COLOURS)],
                          linestyle=style.LINES[i // len(style.COLOURS) % len(style.LINES)],
                          label=label)
        axes.plot(trace[-1, nestings.SECONDS], run["certified_scale"], "o", color=line.get_color(), markersize=5)
    style.log_seconds(axes)
    axes.set_xlabel("seconds of search, set-up excluded")
    axes.set_ylabel("largest scale found")
    axes.set_title("How a search gets there")
    axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1, 0.5))
    bottom = style.caption(fig, "Dots: certified on the triangles. " + records.provenance_line(runs) + ".")
    fig.tight_layout(rect=(0, bottom + 0.01, 1, 1))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "nest_search", reader=nestings.read_folder))
