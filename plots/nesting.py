#!/usr/bin/python3
"""A nesting: the outer shape cut open with the inner one in it, taken apart, and a section through all layers.

    bench nest --outer bunny --free all --record bunny.h5 --meshes bunny
    plots/nesting.py bunny.h5 -o bunny.png
"""

import argparse
import pathlib

import h5py
import numpy as np

import records
import style
from models import read_stl
from solids import Canvas, Raster, rgb
from style import plt

COLOURS = ("#4a7fb5", "#e0803c", "#3f9e78", "#b8609a", "#c9a227")
CUT, BACK = "#dfe6ee", "#8b97a5"
PIXELS = 900


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", help="HDF5 record of a nesting")
    parser.add_argument("--meshes", help="folder of 0.stl, 1.stl ... (default: the record's name without .h5)")
    parser.add_argument("-o", "--output", default="nesting.png", help="PNG to write (default %(default)s)")
    return parser.parse_args()


def read(path, meshes):
    """The shapes in the outermost one's coordinates, from the outside in, and how each cut runs."""
    path = pathlib.Path(path)
    folder = pathlib.Path(meshes) if meshes else path.with_suffix("")
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != "kreisel nesting":
                raise records.BadRecord(f"{path}: not a record of a nesting")
            if "error" in file.attrs or not ("placement" in file or "layers" in file):
                raise records.BadRecord(f"{path}: nothing nests in it, expected a placement")
            found = {"title": file.attrs["shapes"], "commit": file["provenance"].attrs["commit"],
                     "config": dict(file["config"].attrs)}
            if "layers" in file:
                group = file["layers"]
                found["cuts"] = [dict(point=p, normal=n, plus=a, minus=b) for p, n, a, b in
                                 zip(*(group[name][...] for name in
                                       ("plane_point", "plane_normal", "removal_plus", "removal_minus")))]
                found["scales"] = group["table"][...][:, list(group["table"].attrs["columns"]).index("ratio")]
            else:
                group = file["placement"]
                found["cuts"] = [dict(point=group["plane_point"][...], normal=group["plane_normal"][...],
                                      plus=group["removal_plus"][...], minus=group["removal_minus"][...])]
                found["scales"] = [file.attrs["scale"]]
    except OSError:
        raise records.BadRecord(f"{path}: not readable as HDF5") from None
    if not found["cuts"]:
        raise records.BadRecord(f"{path}: no layer in it, expected one at least")
    files = [folder / f"{k}.stl" for k in range(len(found["cuts"]) + 1)]
    for file in files:
        if not file.is_file():
            raise records.BadRecord(f"{file}: no such file, expected the meshes that --meshes wrote")
    return {**found, "shapes": [read_stl(file) for file in files]}


def unit(v):
    return np.asarray(v) / np.linalg.norm(v)


def frame(cut, corners):
    """Right and up of a picture in which the cut is seen from above, along the outer shape's shorter side."""
    normal = unit(cut["normal"])
    flat = corners.reshape(-1, 3) - cut["point"]
    flat = flat - (flat @ normal)[:, None] * normal
    _, axes = np.linalg.eigh(flat.T @ flat)
    right = unit(axes[:, 2] - (axes[:, 2] @ normal) * normal)
    towards = unit(np.cross(right, normal) + 0.62 * normal)
    return right, np.cross(towards, right)


def cut_face(cut, shapes, half):
    """Points of the outer shape's cut, without the hole that the inner one leaves through."""
    normal = unit(cut["normal"])
    across = unit(np.cross(normal, np.eye(3)[np.abs(normal).argmin()]))
    raster = Raster(cut["point"], across, np.cross(normal, across), shapes[0].reshape(-1, 3), PIXELS)
    sign = 1 if half == "plus" else -1
    hole = raster.shadow(shapes[1], lambda p: sign * ((p - cut["point"]) @ normal) >= 0, np.asarray(cut[half]))
    return raster.centres(raster.inside(shapes[0]) & ~hole)


def draw_open(axes, cut, shapes, apart):
    """The lower half with the inner shape in it; apart: and the upper half above them, the inner one between."""
    normal, point = unit(cut["normal"]), cut["point"]
    right, up = frame(cut, shapes[0])
    size = np.ptp(shapes[0].reshape(-1, 3) @ normal)
    lift, half_lift = (0.85 * size * np.asarray(cut["plus"]), 0.42 * size * np.asarray(cut["plus"])) if apart else (0, 0)
    lower = lambda p: (p - point) @ normal <= 0  # noqa: E731
    upper = lambda p: (p - lift - point) @ normal >= 0  # noqa: E731
    everything = [shapes[0].reshape(-1, 3)[lower(shapes[0].reshape(-1, 3))], shapes[1].reshape(-1, 3) + half_lift]
    if apart:
        moved = shapes[0].reshape(-1, 3) + lift
        everything.append(moved[upper(moved)])
    canvas = Canvas(right, up, np.concatenate(everything), PIXELS)
    canvas.triangles(shapes[0], COLOURS[0], lower, BACK)
    face = cut_face(cut, shapes, "minus")
    canvas.points(face, np.tile(rgb(CUT), (len(face), 1)))
    canvas.triangles(shapes[1] + half_lift, COLOURS[1])
    if apart:
        canvas.triangles(shapes[0] + lift, COLOURS[0], upper, BACK)
        face = cut_face(cut, shapes, "plus") + lift
        canvas.points(face, np.tile(rgb(CUT), (len(face), 1)))
    canvas.show(axes)


def draw_section(axes, found):
    """All shapes in the plane of the first removal direction and the outer shape's longer side across it."""
    cut, shapes = found["cuts"][0], found["shapes"]
    along = unit(cut["normal"])
    across, _ = frame(cut, shapes[0])
    centre = shapes[-1].reshape(-1, 3).mean(0)  # the innermost shape is met
    raster = Raster(centre, across, along, shapes[0].reshape(-1, 3), PIXELS)
    image = np.ones((*raster.shape[::-1], 3))
    for k, shape in enumerate(shapes):
        image[raster.inside(shape)] = rgb(COLOURS[k % len(COLOURS)])
    axes.imshow(image, origin="lower", extent=raster.extent(), interpolation="antialiased")
    # Where each cut plane meets the section, within the shape that it cuts.
    for k, each in enumerate(found["cuts"][:6]):
        normal = unit(each["normal"])
        line = np.array([normal @ across, normal @ along])
        if np.linalg.norm(line) < 1e-3:
            continue
        offset = normal @ (np.asarray(each["point"]) - centre)
        foot, way = line * offset / (line @ line), unit([-line[1], line[0]])
        t = np.linspace(-1, 1, 2001) * np.linalg.norm(raster.shape * raster.cell)
        points = foot + t[:, None] * way
        cells = ((points - raster.low) / raster.cell).astype(int)
        good = ((cells >= 0) & (cells < raster.shape)).all(1)
        inside = np.zeros(len(points), bool)
        inside[good] = raster.inside(shapes[k])[cells[good, 1], cells[good, 0]]
        shown = points.copy()
        shown[~inside] = np.nan
        axes.plot(*shown.T, color=style.INK, linewidth=1.0 if k == 0 else 0.6, linestyle=(0, (5, 3)))
    axes.set(aspect="equal")
    axes.grid(False)
    axes.set_xlabel("in the cut")
    axes.set_ylabel("across the cut")


def figure(found):
    cut, shapes = found["cuts"][0], found["shapes"]
    picture = plt.figure(figsize=(11.5, 4.6))
    panels = [picture.add_axes((left, 0.13, width, 0.75)) for left, width in ((0.01, 0.31), (0.33, 0.31), (0.70, 0.29))]
    draw_open(panels[0], cut, shapes[:2], apart=False)
    panels[0].set_title("cut open")
    draw_open(panels[1], cut, shapes[:2], apart=True)
    panels[1].set_title("taken apart")
    draw_section(panels[2], found)
    panels[2].set_title(f"section of all {len(shapes)} shapes" if len(shapes) > 2 else "section")
    scales = ", ".join(f"{s:.3f}" for s in found["scales"][:8]) + (" ..." if len(found["scales"]) > 8 else "")
    picture.suptitle(f"{found['title']}, scale {scales}", x=0.01, ha="left", fontsize=11, fontweight="bold")
    asked = ", ".join(f"{k} {v}" for k, v in sorted(found["config"].items()) if k not in ("outer", "inner"))
    style.caption(picture, f"Dashed: the cut planes where they meet the section. {asked}. Commit {found['commit']}.")
    return picture


def main():
    args = arguments()
    records.save(figure(read(args.record, args.meshes)), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
