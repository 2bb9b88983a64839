#!/usr/bin/python3
"""How large a plane shape nests in another wherever it is put: the largest scale over all rotations."""

import argparse
import pathlib

import h5py
import numpy as np

import records
import style
from style import plt


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("records", help="HDF5 record of a landscape, or a folder, of which the finest is drawn")
    parser.add_argument("-o", "--output", default="nest_landscape.png", help="PNG to write (default %(default)s)")
    return parser.parse_args()


def read(path):
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != "kreisel nesting" or "landscape" not in file:
                raise records.BadRecord(f"{path}: no landscape in it, expected a record of bench nest --landscape")
            group = file["landscape"]
            return {"title": file.attrs["shapes"], "commit": file["provenance"].attrs["commit"], **dict(group.attrs),
                    **{name: data[...] for name, data in group.items()}}
    except OSError:
        reason = "no such file" if not pathlib.Path(path).exists() else "not readable as HDF5"
        raise records.BadRecord(f"{path}: {reason}") from None


def read_finest(path):
    path = pathlib.Path(path)
    if not path.is_dir():
        return read(path)
    found = []
    for file in sorted(path.rglob("*.h5")):
        with h5py.File(file, "r") as record:
            if "landscape" in record:
                found.append(read(file))
    if not found:
        raise records.BadRecord(f"{path}: no landscapes (*.h5) in it")
    return max(found, key=lambda each: each["scale"].size * each["rotations"])


def closed(outline):
    return np.concatenate([outline, outline[:1]]).T


def figure(found):
    scale, (x0, y0), step = found["scale"], found["origin"], found["step"]
    ny, nx = scale.shape
    extent = (x0 - step / 2, x0 + (nx - 0.5) * step, y0 - step / 2, y0 + (ny - 0.5) * step)
    picture, (axes, turned) = plt.subplots(1, 2, figsize=(11, 5.4), layout="constrained")
    best = np.unravel_index(scale.argmax(), scale.shape)
    at = np.array([x0 + step * best[1], y0 + step * best[0]])
    angle = 2 * np.pi * found["rotation"][best] / found["rotations"]
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    image = axes.imshow(np.where(scale > 0, scale, np.nan), origin="lower", extent=extent, cmap="viridis", vmin=0)
    picture.colorbar(image, ax=axes, label="largest scale over all rotations", shrink=0.85)
    axes.set_title(f"best {scale.max():.4f}, turned by {np.degrees(angle):.2f} degrees")
    degrees = np.where(scale > 0, 360 / found["rotations"] * found["rotation"], np.nan)
    image = turned.imshow(degrees, origin="lower", extent=extent, cmap="twilight", vmin=0, vmax=360,
                          interpolation="nearest")  # no colours between 359 and 0 degrees
    picture.colorbar(image, ax=turned, label="rotation that reaches it, degrees", shrink=0.85, ticks=range(0, 361, 90))
    turned.set_title("its rotation")
    for each in (axes, turned):
        each.plot(*closed(found["outer"]), color=style.INK, linewidth=1.2)
        each.axis("off")
    axes.plot(*closed(scale.max() * found["inner"] @ turn.T + at), color="white", linewidth=1.2)
    axes.plot(*at, "o", color="white", markersize=4)
    axes.plot([found["outer"][:, 0].min(), found["outer"][:, 0].max()], [at[1]] * 2, color=style.VERMILION,
              linewidth=1, linestyle=(0, (6, 3)))
    searches = found["inside"] * found["rotations"]
    picture.suptitle(f"{found['title']}: {nx} x {ny} centroids, {found['rotations']} rotations, "
                     f"{searches:.3g} placements in {found['seconds']:.0f} s", x=0.01, ha="left", fontweight="bold")
    picture.supxlabel(f"Cut horizontally through the inner shape's centroid; white: the best of all, dashed: its cut. "
                      f"Commit {found['commit']}.", x=0.01, ha="left", fontsize=7, color=style.QUIET)
    return picture


def main():
    args = arguments()
    records.save(figure(read_finest(args.records)), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
