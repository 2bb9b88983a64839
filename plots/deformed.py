#!/usr/bin/python3
"""A body as it is, hollowed, and deformed and hollowed, with its axis of largest moment [SpinIt, fig. 11].

    bench --model dancers --size 60 --wall 1.2 --formulation quadric --mesh hollowed.stl
    bench --model dancers --size 60 --wall 1.2 --formulation octree --deform least --mesh deformed.stl
    plots/deformed.py hollowed.stl deformed.stl --contact 26.17,25.61,0

Dashed: the axis that it is to spin about. Solid line: the axis of the largest moment, through the centre of mass.
"""

import argparse

import numpy as np

import models
import solids
from style import plt

SPIN, LARGEST = "#2a6f97", "#c1121f"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="+", help="STL of each stage, voids included; the first one's outside is the body as it is")
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
    parts = [models.read_stl(part) for part in options.parts]
    stages = [models.shells(parts[0])[0], *parts]
    figure, axes = plt.subplots(1, len(stages), figsize=(3.4 * len(stages), 3.9))
    for ax, corners in zip(axes, stages):
        stage(ax, corners, contact)
    figure.tight_layout()
    figure.savefig(options.output, dpi=90, bbox_inches="tight")  # titles are wider than what they stand over


if __name__ == "__main__":
    main()
