#!/usr/bin/python3
"""A GIF of a part that spins beside the solid it was made of: the motions of a simulation, in slow motion.

    bench --problem top --model arrow-heart --formulation quadric --resolution 96 --wall 2% --record heart.h5 --mesh heart.stl
    bench simulate heart.h5 --seconds 0.25 --record motion.h5
    plots/spinning.py motion.h5 heart.h5 heart.stl -o spinning.gif

A body that touches the ground far from its tip has fallen, and stays as it is: the simulation knows of no other contact.
It takes the tip for a point; a round one is drawn where it rests on the ground.
"""

import argparse

import h5py
import numpy as np
from PIL import Image, ImageDraw, ImageFont
from matplotlib import font_manager
from matplotlib.colors import to_rgb

import models
import records
import simulate
import style

PANEL, FINE = (250, 230), 3  # pixels of a body's picture, and how many points a pixel is looked at by, a side
EYE = np.radians(14)         # above the ground
LIGHT = np.array([-0.45, -0.6, 0.66])
POINTS = 600_000
FAR = 0.4                    # from the tip, body lengths
SHADES = 14                  # few, which makes a small file


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("motion", help="what bench simulate --record wrote")
    parser.add_argument("run", help="the record of the run that was simulated: where its body frame lies")
    parser.add_argument("mesh", help="its part, binary STL: outer surface and voids")
    parser.add_argument("-o", "--output", default="spinning.gif", help="GIF to write (default %(default)s)")
    parser.add_argument("--frames", type=int, default=80)
    parser.add_argument("--slow", type=float, default=16, help="how many times slower than it is (default %(default)s)")
    return parser.parse_args()


def sampled(corners, count, random):
    """Points spread evenly over triangles, with their normals."""
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(across, axis=1)
    chosen = random.choice(len(corners), count, p=area / area.sum())
    u, v = random.random((2, count, 1))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    t = corners[chosen]
    return t[:, 0] + u * (t[:, 1] - t[:, 0]) + v * (t[:, 2] - t[:, 0]), across[chosen] / area[chosen, None]


def matrix(q):
    x, y, z, w = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class View:
    """Looks at a body on its tip from the side, a little from above."""

    def __init__(self, reach, height):
        self.size = (PANEL[0] * FINE, PANEL[1] * FINE)
        self.scale = min(self.size[0] / (2 * reach), 0.84 * self.size[1] / height)
        self.ground = 0.93 * self.size[1]

    def place(self, points):
        """Columns, rows, and how far away."""
        x, y, z = points.T
        column = self.size[0] / 2 + self.scale * x
        row = self.ground - self.scale * (z * np.cos(EYE) + y * np.sin(EYE))
        return column.astype(int), row.astype(int), y * np.cos(EYE) - z * np.sin(EYE)

    def spots(self, points):
        """Of each point, the farthest first, the four fine pixels that it covers: rows, columns, which point."""
        column, row, depth = self.place(points)
        inside = (column >= 0) & (column < self.size[0] - 1) & (row >= 0) & (row < self.size[1] - 1)
        order = np.repeat(np.flatnonzero(inside)[np.argsort(-depth[inside])], 4)
        beside = np.arange(len(order)) % 4
        return row[order] + beside // 2, column[order] + beside % 2, order

    def mask(self, points):
        hit = np.zeros(self.size[::-1], bool)
        rows, columns, _ = self.spots(points)
        hit[rows, columns] = True
        return hit

    def draw(self, points, normals, colour):
        rows, columns, point = self.spots(points)
        shade = np.round(SHADES * (0.42 + 0.58 * np.clip(normals @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1))) / SHADES
        image = np.ones((*self.size[::-1], 4))
        image[..., 3] = 0
        image[rows, columns, :3] = np.clip(shade[point, None] * np.array(colour) * 1.12, 0, 1)
        image[rows, columns, 3] = 1
        return image


def reduced(image):
    """Each block of fine points as one pixel, on white."""
    blocks = image.reshape(PANEL[1], FINE, PANEL[0], FINE, 4)
    share = blocks[..., 3:].sum(axis=(1, 3))
    colour = (blocks[..., :3] * blocks[..., 3:]).sum(axis=(1, 3)) / np.maximum(share, 1)
    share = share / FINE**2
    return colour * share + 1 - share


def main():
    options = arguments()
    found = simulate.read(options.motion)
    if "attitude" not in found["part"].get("spin", {}):
        raise records.BadRecord(f"{options.motion}: has no attitudes, expected a simulation of what spins, of 2026-12 or later")
    with h5py.File(options.run, "r") as run:
        rotation, origin = run["body/frame_rotation"][...], run["body/frame_origin"][...]
        length = run["body"].attrs["length"]
    random = np.random.default_rng(1)
    outer, voids = [(corners - origin) @ rotation.T / length for corners in models.shells(models.read_stl(options.mesh))]
    skin, hollow = sampled(outer, POINTS, random), sampled(voids, POINTS, random)[0]
    far = np.linalg.norm(skin[0], axis=1) > FAR
    view = View(1.04 * np.hypot(skin[0][:, 0], skin[0][:, 1]).max(), 1.12 * skin[0][:, 2].max())

    small, large = [ImageFont.truetype(font_manager.findfont("DejaVu Sans"), size) for size in (11, 13)]
    step = found["seconds"] / options.frames
    frames, fallen = [], {}
    for number in range(options.frames + 1):
        now = number * step
        frame = Image.new("RGB", (2 * PANEL[0], PANEL[1] + 42), "white")
        pen = ImageDraw.Draw(frame)
        for left, name, colour in ((0, "solid", style.VERMILION), (PANEL[0], "part", style.BLUE)):
            body = found[name]
            times = body["spin"]["motion"][:, 0]
            at = fallen.get(name, min(np.searchsorted(times, now), len(times) - 1))
            turn = matrix(body["spin"]["attitude"][at])
            height = skin[0] @ turn[2]
            if height[far].min() <= height.min():
                fallen.setdefault(name, at)
            centre = body["moments"][1:4] / body["moments"][0]
            slid = -(turn @ centre)  # a tip that glides keeps the centre of mass where it is, but for its height
            slid[2] = -height.min()
            image = view.draw(skin[0] @ turn.T + slid, skin[1] @ turn.T, to_rgb(colour))
            if name == "part":
                inside = view.mask(hollow @ turn.T + slid) & (image[..., 3] > 0)
                image[inside, :3] = 0.55 * image[inside, :3] + 0.45
            picture = Image.fromarray((255 * reduced(image)).astype(np.uint8))
            frame.paste(picture, (left, 24))
            ground = 24 + int(view.ground / FINE)
            pen.line([(left + 20, ground), (left + PANEL[0] - 20, ground)], fill=style.QUIET)
            title = {"solid": "solid", "part": "hollowed (the void is pale)"}[name]
            pen.text((left + 14, 6), title, font=large, fill=colour)
            pen.text((left + 14, PANEL[1] + 24), "has fallen over" if name in fallen else
                     f"tilt {body['spin']['motion'][at, 1]:.0f} degrees", font=small, fill=style.INK)
        pen.text((2 * PANEL[0] - 14, PANEL[1] + 24), f"{found['rpm']:.0f} rpm, {1000 * now:.0f} ms", font=small,
                 fill=style.QUIET, anchor="ra")
        frames.append(frame)
    palette = frames[len(frames) // 3].quantize(48, method=Image.Quantize.MEDIANCUT)
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    milliseconds = 10 * round(100 * step * options.slow)
    frames[0].save(options.output, save_all=True, append_images=frames[1:], loop=0, optimize=True,
                   duration=[milliseconds] * options.frames + [1500])


if __name__ == "__main__":
    records.main_with(main)
