#!/usr/bin/python3
"""A mould as `design --mould` writes it: both halves as they are printed, cavity up, and what is cast in it."""

import argparse
import pathlib

import numpy as np

import models
import solids
from style import plt

CLAY, METAL = "#d9cbb3", "#8d99ae"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", help="the STL that `design -o` was given")
    parser.add_argument("--of", default="interior", help="which material is cast (default %(default)s)")
    parser.add_argument("-o", "--output", default="mould.png", help="PNG to write (default %(default)s)")
    return parser.parse_args()


def draw(axes, corners, colour, title, height=0.75):
    """Seen from the front and above; `height` is how far above, 1 straight down."""
    towards = np.array([0.25, -np.sqrt(1 - height**2), height])
    towards /= np.linalg.norm(towards)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    canvas = solids.Canvas(right, np.cross(towards, right), corners.reshape(-1, 3), 900)
    canvas.triangles(corners, colour)
    canvas.show(axes)
    axes.set_title(title, fontsize=9)


def main():
    options = arguments()
    part = pathlib.Path(options.part)
    stem = part.with_name(f"{part.stem}-{options.of}")
    figure, axes = plt.subplots(1, 3, figsize=(9, 3))
    for ax, half in zip(axes, ("lower", "upper")):
        draw(ax, models.read_stl(f"{stem}-mould-{half}.stl"), CLAY, f"{half} half")
    draw(axes[2], models.read_stl(f"{stem}.stl"), METAL, f"{options.of}, as it lies in the part", 0.4)
    figure.tight_layout()
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
