#!/usr/bin/python3
"""A gallery of meshes: binary STL files, each seen a little from above, as `bench --mesh` writes them.

    for m in duck kitten; do bench --model $m --resolution 24 --mesh $m.stl; done
    plots/models.py duck.stl kitten.stl -o models.png
"""

import argparse
import pathlib

import numpy as np

import records
import style
from style import plt

PIXELS = 300
TOWARDS = np.array([0.62, -0.66, 0.43])  # from the mesh to the eye


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="+", help="binary STL files, z up")
    parser.add_argument("-o", "--output", default="models.png", help="PNG to write (default %(default)s)")
    parser.add_argument("--columns", type=int, default=5, help="pictures a row (default %(default)s)")
    return parser.parse_args()


def read_stl(path):
    """Corners of every triangle, [n, 3, 3]."""
    data = pathlib.Path(path).read_bytes()
    count = int.from_bytes(data[80:84], "little")
    if len(data) != 84 + 50 * count or count == 0:
        raise records.BadRecord(f"{path}: not a binary STL file with triangles")
    row = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    return np.frombuffer(data, row, count, 84)["corners"].astype(float)


def shells(corners):
    """Corners of the outer surface, and of all that it encloses: surfaces that hang together by equal vertices."""
    _, vertex = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    faces, label = vertex.reshape(-1, 3), np.arange(vertex.max() + 1)
    while True:  # the least number among neighbours, until none changes
        least = label[faces].min(axis=1)
        new = label.copy()
        np.minimum.at(new, faces.ravel(), np.repeat(least, 3))
        new = new[new]
        if (new == label).all():
            break
        label = new
    shell = label[faces[:, 0]]
    extent = {s: np.ptp(corners[shell == s].reshape(-1, 3), axis=0).max() for s in np.unique(shell)}
    outer = shell == max(extent, key=extent.get)
    return corners[outer], corners[~outer]


def shaded(corners):
    """Grey values [PIXELS, PIXELS] of an orthographic view, NaN beside the mesh: each triangle is sampled at
    points less than a pixel apart, and the sample nearest to the eye wins."""
    towards = TOWARDS / np.linalg.norm(TOWARDS)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    up = np.cross(towards, right)
    lo, hi = corners.min((0, 1)), corners.max((0, 1))
    scale = 0.97 * PIXELS / np.linalg.norm(hi - lo)
    seen = (corners - (lo + hi) / 2) @ np.stack([right, -up, towards]).T * scale + [PIXELS / 2, PIXELS / 2, 0]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-300
    light = towards + 0.6 * up - 0.5 * right
    grey = 0.25 + 0.75 * np.clip(normal @ (light / np.linalg.norm(light)), 0, 1)
    depth, image = np.full(PIXELS * PIXELS, -np.inf), np.full(PIXELS * PIXELS, np.nan)
    steps = np.ceil(1.5 * np.ptp(seen[:, :, :2], axis=1).max(1)).astype(int) + 1
    front = np.flatnonzero(normal @ towards > 0)
    for count in np.unique(steps[front]):
        some = front[steps[front] == count]
        u, v = (grid.ravel() for grid in np.meshgrid(*2 * [np.linspace(0, 1, count + 1)]))
        weights = np.stack([1 - u - v, u, v])[:, u + v < 1 + 1e-9]
        points = np.einsum("kp,nkc->npc", weights, seen[some]).reshape(-1, 3)
        cell = np.clip(points[:, :2].astype(int), 0, PIXELS - 1) @ [1, PIXELS]
        order = np.argsort(points[:, 2], kind="stable")
        value = np.repeat(grey[some], weights.shape[1])[order]
        near, best = np.full(PIXELS * PIXELS, -np.inf), np.zeros(PIXELS * PIXELS)
        near[cell[order]], best[cell[order]] = points[order, 2], value  # the last one written is the nearest
        image = np.where(near > depth, best, image)
        depth = np.maximum(near, depth)
    return image.reshape(PIXELS, PIXELS)


def main():
    args = arguments()
    columns = min(args.columns, len(args.meshes))
    rows = -(-len(args.meshes) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(1.7 * columns, 1.95 * rows), squeeze=False)
    for cell in axes.flat:
        cell.axis("off")
    colours = plt.matplotlib.colors.LinearSegmentedColormap.from_list("solid", ["#101820", style.SOLID, "white"])
    for cell, path in zip(axes.flat, args.meshes):
        cell.imshow(shaded(read_stl(path)), cmap=colours, vmin=0, vmax=1.15)
        cell.set_title(pathlib.Path(path).stem, fontsize=8)
    figure.tight_layout(pad=0.3)
    records.save(figure, args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
