#!/usr/bin/python3
"""Draws one layer of prints as their beads lie, with the axis and the centre of mass of the whole print.

Each print is a report of `design --json` and the G-code beside it (--gcode), both with the same stem, as
plots/printed.py leaves them.
"""

import argparse
import json
import pathlib
import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection

import style

WALL, FULL, SPARSE = "#23415f", "#6f9fcf", "#e69f00"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("report", nargs="+", help="JSON of design, with STEM.gcode beside it")
    parser.add_argument("--title", action="append", default=[], help="of each print, in their order")
    parser.add_argument("--height", type=float, default=0.5, help="of the layer, share of the print's (default %(default)s)")
    parser.add_argument("-o", "--output", default="beads.png", help="picture (default %(default)s)")
    return parser.parse_args()


def beads(gcode):
    """By height, mm: lists of (from, to, width, type), as PrusaSlicer's comments and relative E have them."""
    layers, at, kind, width, layer, relative, extruded = {}, np.zeros(2), "", 0.45, None, False, 0.0
    for line in gcode.open(errors="replace"):
        if line.startswith(";Z:"):
            layer = layers.setdefault(float(line[3:]), [])
        elif line.startswith(";TYPE:"):
            kind = line[6:].strip()
        elif line.startswith(";WIDTH:"):
            width = float(line[7:])
        elif line.startswith(("M82", "M83")):
            relative = line.startswith("M83")
        elif line.startswith(("G0 ", "G1 ", "G92")):
            words = {w[0]: float(w[1:]) for w in line.split(";")[0].split()[1:] if re.fullmatch(r"[XYZEF]-?[\d.]+", w)}
            to = np.array([words.get("X", at[0]), words.get("Y", at[1])])
            laid = words.get("E", 0 if relative else extruded) - (0 if relative else extruded)
            extruded = words.get("E", extruded)
            if line.startswith("G92"):
                continue
            if laid > 0 and layer is not None and (to != at).any():
                layer.append((at, to, width, kind))
            at = to
    return {z: laid for z, laid in layers.items() if laid}


def draw(axes, report, gcode, height):
    said = json.loads(report.read_text())
    motion = np.array(said["print"]["bed_to_model"])
    on_bed = lambda point: motion[:, :3].T @ (np.array(point) - motion[:, 3])
    axis, centre = on_bed(said["contact"]), on_bed(said["print"]["centre_of_mass_mm"])
    layers = beads(gcode)
    z = sorted(layers)[round(height * (len(layers) - 1))]
    for colour, wanted in ((SPARSE, lambda k: k == "Internal infill"), (FULL, lambda k: "infill" in k.lower() and k != "Internal infill"),
                           (WALL, lambda k: "perimeter" in k.lower())):
        shapes = []
        for a, b, width, kind in layers[z]:
            if wanted(kind):
                along = (b - a) / np.linalg.norm(b - a)
                side = width / 2 * np.array([-along[1], along[0]])
                shapes.append([a - axis[:2] + side, b - axis[:2] + side, b - axis[:2] - side, a - axis[:2] - side])
        axes.add_collection(PolyCollection(shapes, facecolors=colour, edgecolors="none"))
    axes.axhline(0, color=style.GRID, zorder=0)
    axes.axvline(0, color=style.GRID, zorder=0)
    axes.plot(0, 0, "+", color=style.INK, markersize=14, markeredgewidth=1.6)
    off = centre[:2] - axis[:2]
    axes.plot(*off, "o", color=style.VERMILION, markersize=6, markeredgecolor="white")
    axes.autoscale()
    axes.set_aspect("equal")
    axes.grid(False)
    miss = said["print"]["constraint_residual"]
    axes.set_xlabel(f"{miss['centre_of_mass_mm']:.2g} mm off, {miss['axis_degrees']:.2g} degrees tilted\n"
                    f"{said['print']['mass_g']:.1f} g: it {'spins' if said['print']['ok'] else 'does not spin'}")


def main():
    options = arguments()
    figure, all_axes = plt.subplots(1, len(options.report), figsize=(4 * len(options.report), 3.9), sharey=True, squeeze=False)
    for k, (name, axes) in enumerate(zip(options.report, all_axes[0])):
        report = pathlib.Path(name)
        draw(axes, report, report.with_suffix(".gcode"), options.height)
        axes.set_title(options.title[k] if k < len(options.title) else report.stem)
    all_axes[0][0].set_ylabel("mm from the axis")
    top = style.caption(figure, "One layer as its beads lie. Dark: walls. Orange: infill, filled or sparse. Blue: closed layers. Cross: the axis. "
                                "Dot: the centre of mass of the whole print.")
    figure.tight_layout(rect=(0, top, 1, 1))
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
