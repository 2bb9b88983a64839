#!/usr/bin/python3
"""Nestings: the outer shape cut open with the inner one in it, taken apart, and a section through all layers.

    bench nest --outer bunny --free all --keep-shapes yes --record bunny.h5
    plots/nest_picture.py bunny.h5 -o bunny.png
"""

import argparse
import pathlib

import h5py
import numpy as np

import records
import style
from solids import Canvas, Raster, rgb
from style import plt

COLOURS = ("#4a7fb5", "#e0803c", "#3f9e78", "#b8609a", "#c9a227")
CUT, BACK = "#dfe6ee", "#8b97a5"
PIXELS = 900


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("records", help="HDF5 record of a nesting with its shapes (--keep-shapes), or a folder of some")
    parser.add_argument("-o", "--output", default="nest_picture.png", help="PNG to write (default %(default)s)")
    return parser.parse_args()


def moved(corners, rows):
    return corners @ rows[:, :3].T + rows[:, 3]


def read(path):
    """The shapes in the outermost one's coordinates, from the outside in, and how each cut runs. None: no picture."""
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != "kreisel nesting":
                raise records.BadRecord(f"{path}: not a record of a nesting")
            if "shapes" not in file or not file.attrs["valid"]:
                return None
            meshes = [file[f"shapes/{k}/vertices"][...][file[f"shapes/{k}/triangles"][...]] for k in range(len(file["shapes"]))]
            found = {"title": file.attrs["shapes"], "commit": file["provenance"].attrs["commit"], "config": dict(file["config"].attrs)}
            if "layers" in file:
                group = file["layers"]
                cuts = zip(*(group[name][...] for name in ("plane_points", "plane_normals", "removal_plus", "removal_minus")))
                rows = group["transforms"][...].reshape(-1, 3, 4)
                table = dict(zip(group["table"].attrs["columns"], group["table"][...].T))
                inner, found["scales"] = table["inner"].astype(int), table["ratio"]
            else:
                group = file["placement"]
                cuts = [[group[name][...] for name in ("plane_point", "plane_normal", "removal_plus", "removal_minus")]]
                rows, inner, found["scales"] = [group["transform"][...]], [len(meshes) - 1], [file.attrs["scale"]]
            found["cuts"] = [dict(zip(("point", "normal", "plus", "minus"), cut)) for cut in cuts]
            found["shapes"] = [meshes[0]] + [moved(meshes[k], row) for k, row in zip(inner, rows)]
            return found
    except OSError:
        reason = "not readable as HDF5" if pathlib.Path(path).exists() else "no such file"
        raise records.BadRecord(f"{path}: {reason}") from None


def read_all(path):
    path = pathlib.Path(path)
    files = [path] if not path.is_dir() else [p for p in sorted(path.rglob("*.h5")) if records.is_nesting(p)]
    found = [each for each in map(read, files) if each]
    if not found:
        raise records.BadRecord(f"{path}: no nesting with its shapes, expected one that was found with --keep-shapes yes")
    return found


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
    raster = Raster(cut["point"], across, np.cross(normal, across), shapes[0].reshape(-1, 3), 2 * PIXELS)  # finer than the picture: no gaps
    sign = 1 if half == "plus" else -1
    hole = raster.shadow(shapes[1], lambda p: sign * ((p - cut["point"]) @ normal) >= 0, np.asarray(cut[half]))
    return raster.centres(raster.inside(shapes[0]) & ~hole)


def draw_open(axes, cut, shapes, apart):
    """The lower half with the inner shape in it; apart: and the upper half above them, the inner one between."""
    normal, point = unit(cut["normal"]), cut["point"]
    right, up = frame(cut, shapes[0])
    size = np.ptp(shapes[0].reshape(-1, 3) @ normal)
    lift, half_lift = (1.1 * size * np.asarray(cut["plus"]), 0.5 * size * np.asarray(cut["plus"])) if apart else (0, 0)
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
    axes.axis("off")


def draw(picture, found, bottom, height):
    """One nesting in a strip of the figure, whose lower edge and height are parts of it."""
    cut, shapes = found["cuts"][0], found["shapes"]
    panels = [picture.add_axes((left, bottom + 0.02 * height, width, 0.84 * height))
              for left, width in ((0.01, 0.31), (0.33, 0.31), (0.69, 0.30))]
    draw_open(panels[0], cut, shapes[:2], apart=False)
    draw_open(panels[1], cut, shapes[:2], apart=True)
    draw_section(panels[2], found)
    scales = ", ".join(f"{s:.3f}" for s in found["scales"][:9]) + (" ..." if len(found["scales"]) > 9 else "")
    count = f"{len(shapes) - 1} layers: " if len(shapes) > 2 else "scale "
    picture.text(0.01, bottom + 0.9 * height, f"{found['title']}, {count}{scales}", fontsize=11, fontweight="bold")


def figure(all_found):
    inches = 4.4
    picture = plt.figure(figsize=(11.5, inches * len(all_found) + 0.4))
    foot = 0.4 / picture.get_figheight()
    for row, found in enumerate(reversed(all_found)):
        draw(picture, found, foot + row * (1 - foot) / len(all_found), (1 - foot) / len(all_found))
    commits = ", ".join(sorted({found["commit"] for found in all_found}))
    style.caption(picture, "Cut open; taken apart; a section across the cut through all shapes, dashed: the cuts, each within the "
                           f"shape it cuts. Commit {commits}.")
    return picture


def main():
    args = arguments()
    records.save(figure(read_all(args.records)), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
