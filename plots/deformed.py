#!/usr/bin/python3
"""A body as it is, hollowed, and deformed and hollowed, with its axis of largest moment [SpinIt, fig. 11]."""

import argparse

import numpy as np

import models
import solids
from style import plt

SPIN, LARGEST = "#2a6f97", "#c1121f"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="+", help="STL of each stage, voids included")
    parser.add_argument("--contact", required=True, help="point x,y,z that the axis of spin (z) goes through, mm")
    parser.add_argument("-o", "--output", default="deformed.png", help="PNG to write (default %(default)s)")
    return parser.parse_args()


def principal(corners):
    """Volume, centre of mass, principal moments about it and their axes of what closed triangles bound."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    total = volumes.sum()
    centre = (volumes[:, None] * (a + b + c)).sum(0) / 4 / total
    around = corners - centre
    sums = around.sum(1)
    second = (np.einsum("t,tki,tkj->ij", volumes, around, around) + np.einsum("t,ti,tj->ij", volumes, sums, sums)) / 20
    moments, axes = np.linalg.eigh(np.trace(second) * np.eye(3) - second)
    return total, centre, moments, axes


def draw_line(axes, canvas, point, direction, colour, style="-"):
    ends = (np.array([point - 34 * direction, point + 34 * direction]) @ canvas.axes[:2].T - canvas.low) / canvas.pixel
    axes.plot(*ends.T, style, color=colour, linewidth=1.2)


def stage(axes, corners, contact):
    volume, centre, moments, directions = principal(corners)
    largest = directions[:, 2] * np.sign(directions[2, 2])
    tilt = np.degrees(np.arccos(np.clip(largest[2], -1, 1)))
    canvas = solids.Canvas(np.array([1.0, 0, 0]), np.array([0, 0.25, 1.0]) / np.hypot(1, 0.25),
                           corners.reshape(-1, 3), 900)
    canvas.triangles(corners, "#d9cbb3")
    canvas.show(axes)
    draw_line(axes, canvas, np.array([*contact[:2], centre[2]]), np.array([0, 0, 1.0]), SPIN, "--")
    draw_line(axes, canvas, centre, largest, LARGEST)
    axes.set_title(f"{volume / 1e3:.2f} cm³, off the axis {np.hypot(*(centre - contact)[:2]):.2f} mm,\n"
                   f"largest axis {tilt:.1f}° off, its moment {moments[2] / moments[1]:.2f} of the next", fontsize=8)


def main():
    options = arguments()
    contact = np.array([float(v) for v in options.contact.split(",")])
    figure, axes = plt.subplots(1, len(options.parts), figsize=(3.4 * len(options.parts), 3.6))
    for ax, part in zip(np.atleast_1d(axes), options.parts):
        stage(ax, models.read_stl(part), contact)
    figure.tight_layout()
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
