#!/usr/bin/python3
"""Seconds and variables of each body beside a paper's, which are drawn hollow."""

import records
import style
from style import plt

THEIRS = "published.rayrep."


def draw_panel(axes, rows, column, looks):
    """rows: {body: [(run, setting)]}; a column of theirs is drawn along x, and the paper's."""
    for y, (body, runs) in enumerate(rows.items()):
        for run, text in runs:
            colour, marker = looks[text]
            axes.plot(run[column], y, marker=marker if run["converged"] else "x", color=colour, markersize=6,
                      linestyle="none", zorder=3)
        theirs = next((run[THEIRS + column] for run, _ in runs if run[THEIRS + column] is not None), None)
        if theirs is not None:
            axes.plot(theirs, y, marker="D", markersize=7, markerfacecolor="none", linestyle="none",
                      markeredgecolor=style.INK, markeredgewidth=1.1, zorder=4)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_yticks(range(len(rows)), [f"{body[0]}\n{body[1]}, {body[2]}" for body in rows], fontsize=8)
    axes.tick_params(axis="y", length=0)


def figure(found, published):
    runs = records.solved(found, "variables", THEIRS + "seconds", THEIRS + "variables", published=published)
    source, printed = records.read_published(published)
    texts = {}
    for group in records.by_body(runs, "formulation").values():
        for run, fields in zip(group, records.differences(group)):
            texts[run["path"]] = records.setting_text(fields)
    rows = {body: [(r, texts[r["path"]]) for r in group] for body, group in records.by_body(runs).items()}
    order = [row["model"] for row in printed]
    rows = dict(sorted(rows.items(), key=lambda item: order.index(item[0][0]) if item[0][0] in order else 99))
    looks = {text: (style.COLOURS[i % len(style.COLOURS)], style.MARKERS[i % len(style.MARKERS)])
             for i, text in enumerate(dict.fromkeys(texts.values()))}
    fig, (left, right) = plt.subplots(1, 2, sharey=True, figsize=(9, 0.55 * len(rows) + 1.9))
    draw_panel(left, rows, "seconds", looks)
    draw_panel(right, rows, "variables", looks)
    style.log_seconds(left)
    left.set_title("seconds of the solve")
    right.set_title("variables")
    right.set_xlim(0, 1.05 * right.get_xlim()[1])
    for text, (colour, marker) in looks.items():
        left.plot([], [], color=colour, marker=marker, linestyle="none", label=text)
    left.plot([], [], color=style.INK, marker="D", markerfacecolor="none", linestyle="none", label="published")
    handles, labels = left.get_legend_handles_labels()
    low = style.caption(fig, "Other meshes and another machine than the paper's. Cross: did not converge. "
                        f"{records.provenance_line(runs)}. Published: {source}.")
    fig.legend(handles, labels, loc="upper right", ncol=min(len(labels), 3), fontsize=8)
    fig.tight_layout(rect=(0, low, 1, 1 - 0.32 / fig.get_figheight()))
    return fig


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "published", "rayrep_table1"))
