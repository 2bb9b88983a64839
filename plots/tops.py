#!/usr/bin/python3
"""Tops cut open beside each other, one for each thing that is lowered, with how much slower each may spin."""

import pathlib

import numpy as np

import models
import records
import style
from section import written
from solids import Canvas, Raster, rgb
from style import plt

PIXELS = 900
TILT = 0.3  # sine of the angle from above at which the eye looks
OBJECTIVES = {"none": "inertia only", "height": "lowering", "mass": "lowering and mass"}


def lowered(run):
    return run["config"].get("problem.lower", "mass")


RATIO, THEIRS = "verified.omega_reduction", "published.omega_reduction"


def by_model(found, published):
    """{model: {what is lowered: run}} of tops whose meshes are at hand and whose weights are the default; of several
    walls the one whose three ratios come nearest to the paper's."""
    groups = {}
    for run in records.solved(found, RATIO, THEIRS, published=published):
        plain = "problem.gamma_c" not in run["config"] and "problem.gamma_i" not in run["config"]
        if run["problem"] == "top" and plain and written(run["record"]):
            walls = groups.setdefault(run["config"]["model"], {})
            walls.setdefault(run["config"]["wall"], {})[lowered(run)] = run
    best = {}
    for model, walls in groups.items():
        whole = [runs for runs in walls.values() if len(runs) == len(OBJECTIVES)]
        if whole:
            best[model] = min(whole, key=lambda runs: sum((run[RATIO] - (run[THEIRS] or 0)) ** 2 for run in runs.values()))
    return best


def draw(axes, run):
    """The half behind the plane through the axis and the body's longer side, seen from a little above."""
    body = run["body"]
    corners = models.read_stl(written(run)["part"]["path"])
    corners = (corners - body["frame_origin"]) @ np.asarray(body["frame_rotation"]).T
    behind = lambda p: p[:, 1] >= 0  # noqa: E731
    right, up = np.array([1.0, 0, 0]), np.array([0, TILT, np.sqrt(1 - TILT * TILT)])
    kept = corners.reshape(-1, 3)
    canvas = Canvas(right, up, kept[behind(kept)], PIXELS)
    canvas.triangles(corners, "#c9d3de", behind, "#9aa7b5")
    raster = Raster(np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), kept, 2 * PIXELS)
    face = raster.centres(raster.inside(corners))
    canvas.points(face, np.tile(rgb(style.SOLID), (len(face), 1)))
    canvas.show(axes)


def figure(found, published):
    groups = by_model(found, published)
    if not groups:
        raise records.BadRecord("no tops with their meshes, expected runs of top that lower none, height and mass")
    picture, axes = plt.subplots(len(groups), 3, figsize=(12, 2.7 * len(groups) + 0.4), squeeze=False)
    for line, (model, runs) in zip(axes, sorted(groups.items(), reverse=True)):
        for ax, (lower, words) in zip(line, OBJECTIVES.items()):
            run = runs[lower]
            draw(ax, run["record"])
            theirs = run[THEIRS]
            beside = f" (paper: {theirs:.2f})" if theirs else ""
            ax.set_title(f"{words}: {run[RATIO]:.2f} times slower{beside}", fontsize=9)
            ax.text(0, 0.01, f"{pathlib.Path(model).name}, wall {run['config']['wall']}",
                    transform=ax.transAxes, fontsize=8, color=style.QUIET)
    picture.tight_layout(rect=(0, 0.3 / picture.get_figheight(), 1, 1))
    shown = [run for runs in groups.values() for run in runs.values()]
    style.caption(picture, "Parts as written, cut along the axis: blue where material is cut. How much slower than the solid each may "
                           f"spin, by [SpinIt, eq. 1]. {records.provenance_line(shown)}.")
    return picture


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "tops", published="spinit_teapot"))
