#!/usr/bin/python3
"""The optimised interior in a vertical plane: which part of the domain stays solid, which becomes void."""

import argparse
import pathlib

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Patch

import records
import style
from style import plt


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", help="HDF5 record of a run")
    parser.add_argument("-o", "--output", default="section.png", help="PNG to write (default %(default)s)")
    parser.add_argument("--row", type=int, help="row of cells along y to cut (default: the middle one)")
    return parser.parse_args()


def row_to_cut(run, row):
    """The asked row, else the one nearest to the middle that has an interior."""
    rows = np.unique(run["domain"]["intervals"][:, 1])
    count = int(run["domain"]["grid"][1])
    if row is None:
        return int(rows[np.abs(rows + 0.5 - count / 2).argmin()])
    if row not in rows:
        raise records.BadRecord(f"{run['path']}: row {row} has no interior, expected {rows[0]} to {rows[-1]}")
    return row


class Slab:
    """The intervals of one row, in millimetres of the body frame: z along the axis, origin at the contact."""

    def __init__(self, run, row):
        domain, body = run["domain"], run["body"]
        self.run, self.row, self.mm = run, row, body["length"]
        self.cell = domain["spacing"] * self.mm
        self.corner = domain["grid_origin"] * self.mm
        self.picked = np.flatnonzero(domain["intervals"][:, 1] == row)
        self.cells = domain["intervals"][self.picked]
        self.x = self.corner[0] + (self.cells[:, 0] + 0.5) * self.cell
        exact = domain["kind"] == "exact"  # heights in body lengths; else faces of cells
        self.low, self.high = (self.cells[:, k] * self.mm if exact else self.corner[2] + self.cells[:, k] * self.cell
                               for k in (2, 3))
        self.y = self.corner[1] + (row + 0.5) * self.cell

    def segments(self):
        """Ray-rep: both ends of each ray's solid segment. With one variable a ray it begins at the ray's lower end."""
        x = self.run["solve"]["x"] * self.run["solve"]["x_unit_length"] * self.mm
        rays = len(self.run["domain"]["intervals"])
        ends = x.reshape(rays, -1)[self.picked]
        return (self.low if ends.shape[1] == 1 else ends[:, 0]), ends[:, -1]

    def cut_by_quadric(self):
        """Quadric: pieces of the rays where it is negative, as (ray, from, to)."""
        q, h = self.run["solve"]["x"], self.cell / self.mm
        x, y = self.x / self.mm, self.y / self.mm
        c = q[0] + q[1] * x + q[2] * y + q[4] * x * y + q[7] * (x * x + h * h / 12) + q[8] * (y * y + h * h / 12)
        b = q[3] + q[5] * y + q[6] * x
        for ray, (low, high) in enumerate(zip(self.low / self.mm, self.high / self.mm)):
            roots = np.roots(np.trim_zeros([q[9], b[ray], c[ray]], "f"))
            inside = [z.real for z in roots if abs(z.imag) == 0 and low < z.real < high]
            ends = [low, *sorted(inside), high]
            for z0, z1 in zip(ends, ends[1:]):
                middle = (z0 + z1) / 2
                if c[ray] + middle * (b[ray] + middle * q[9]) < 0:
                    yield ray, z0 * self.mm, z1 * self.mm

    def cubes(self):
        """Octree: the cells that the plane cuts, ix, iz, edge, and their fills."""
        cells = self.run["solve"]["cells"]
        row = self.row - cells[:, 1]
        cut = (row >= 0) & (row < cells[:, 3])
        return cells[cut][:, (0, 2, 3)], self.run["solve"]["x"][cut]

    def fills(self):
        """Voxel or octree: the fill of every voxel of the plane, [nz, nx]; NaN outside the domain."""
        grid, all_cells = self.run["domain"]["grid"], self.run["domain"]["intervals"]
        if self.run["formulation"] == "octree":
            plane, outside = np.full((grid[2], grid[0]), np.nan), np.full((grid[2], grid[0]), True)
            for (ix, iz, edge), fill in zip(*self.cubes()):
                plane[iz:iz + edge, ix:ix + edge] = fill
            for ix, _, k0, k1 in self.cells:
                outside[k0:k1, ix] = False
            plane[outside] = np.nan
            return plane
        lengths = all_cells[:, 3] - all_cells[:, 2]
        first = np.concatenate(([0], np.cumsum(lengths)))
        plane = np.full((grid[2], grid[0]), np.nan)
        for picked, (ix, _, k0, k1) in zip(self.picked, self.cells):
            plane[k0:k1, ix] = self.run["solve"]["x"][first[picked]:first[picked + 1]]
        return plane


def written(run):
    """{material: attributes with its STL as "path"}, shell or part first; empty where the files are not at hand."""
    materials = run["verified"]["materials"] or {"part": {"file": run["verified"]["file"]}}
    first = next(name for name in ("part", "shell") if name in materials)
    found = {}
    for name in (first, *(n for n in ("interior", "filling") if n in materials)):
        file = pathlib.Path(materials[name]["file"] or "none")
        if not file.is_file():  # the record may have moved: meshes lie beside their records
            stem = pathlib.Path(run["path"]).with_suffix("").name
            file = pathlib.Path(run["path"]).with_name(f"{stem}{'' if name == first else '-' + name}.stl")
        if file.is_file():
            found[name] = {**materials[name], "path": file}
    return found if first in found else {}


def outline(run, file, y):
    """Where a written surface crosses the plane, [segments, 2 ends, (x, z)] in mm of the body frame."""
    with open(file, "rb") as stl:
        stl.seek(80)
        count = int(np.fromfile(stl, "<u4", 1)[0])
        corners = np.fromfile(stl, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")]),
                              count)["corners"].astype(float)
    body = run["body"]
    corners = (corners - body["frame_origin"]) @ np.asarray(body["frame_rotation"]).T
    above = corners[:, :, 1] > y
    crossed = corners[above.any(axis=1) & ~above.all(axis=1)]
    # The corner that is alone on its side comes first; both its edges cross.
    above = crossed[:, :, 1] > y
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(crossed))
    apex = crossed[rows, alone]
    ends = []
    for step in (1, 2):
        other = crossed[rows, (alone + step) % 3]
        t = (y - apex[:, 1]) / (other[:, 1] - apex[:, 1])
        ends.append((apex + t[:, None] * (other - apex))[:, (0, 2)])
    return np.stack(ends, axis=1)


MATERIALS = {"part": style.SOLID, "shell": "#9db8d2", "interior": style.SOLID, "filling": style.COLOURS[4]}


def draw_materials(axes, slab, files):
    """What each file holds in the plane: along a vertical line, between its crossings by turns. @return handles"""
    handles = []
    for name, material in files.items():
        lines = outline(slab.run, material["path"], slab.y)
        low, high = lines[:, :, 0].min(axis=1), lines[:, :, 0].max(axis=1)
        leaning = low < high  # those upright in the plane cross no vertical line
        lines, low, high = lines[leaning], low[leaning], high[leaning]
        slope = np.diff(lines[:, :, 1], axis=1)[:, 0] / np.diff(lines[:, :, 0], axis=1)[:, 0]
        grid = np.linspace(low.min(), high.max(), 800)
        pieces = []
        for x in (grid[1:] + grid[:-1]) / 2:
            at = (low <= x) & (x < high)
            z = np.sort(lines[at, 0, 1] + slope[at] * (x - lines[at, 0, 0]))
            if len(z) % 2 == 0:  # else it runs along an edge
                pieces += [(x, *ends) for ends in z.reshape(-1, 2)]
        x, bottom, top = np.array(pieces).T
        axes.add_collection(LineCollection(
            np.stack([np.stack([x, bottom], 1), np.stack([x, top], 1)], 1), colors=MATERIALS[name], capstyle="butt",
            linewidths=72 * axes.get_position().width * axes.figure.get_figwidth() / 700))
        handles.append(Patch(color=MATERIALS[name], label=f"{name}, {material['density']:g} g/cm³"))
    return handles


def draw_interior(axes, slab):
    if slab.run["formulation"] not in ("voxel", "octree"):
        # Neighbouring bars overlap by a hair, else the seams between them shine through.
        width = slab.cell * 1.03
        axes.bar(slab.x, slab.high - slab.low, width, slab.low, color=style.VOID, linewidth=0)
        if slab.run["formulation"] == "rayrep":
            x, (low, high) = slab.x, slab.segments()
        else:
            ray, low, high = np.array([*slab.cut_by_quadric()]).reshape(-1, 3).T
            x = slab.x[ray.astype(int)]
        axes.bar(x, high - low, width, low, color=style.SOLID, linewidth=0)
        return
    plane = slab.fills()
    left, bottom = slab.corner[0], slab.corner[2]
    axes.imshow(plane, origin="lower", interpolation="nearest", vmin=0, vmax=1, aspect="equal", zorder=1,
                extent=(left, left + plane.shape[1] * slab.cell,
                        bottom, bottom + plane.shape[0] * slab.cell),
                cmap=LinearSegmentedColormap.from_list("fill", (style.VOID, style.SOLID)))
    if slab.run["formulation"] == "octree":
        cubes, _ = slab.cubes()
        x, z, edge = left + cubes[:, 0] * slab.cell, bottom + cubes[:, 1] * slab.cell, cubes[:, 2] * slab.cell
        corners = np.stack([np.stack(corner, axis=1) for corner in
                            ((x, z), (x + edge, z), (x + edge, z + edge), (x, z + edge), (x, z))], axis=1)
        axes.add_collection(LineCollection(corners, colors=style.INK, alpha=0.35, linewidths=0.25, zorder=2))


def centre(moments):
    return moments[1:4] / moments[0]


def draw_marks(axes, slab):
    run = slab.run
    axes.axvline(0, color=style.QUIET, linewidth=0.9, linestyle=(0, (6, 3)), label="axis through the contact")
    axes.plot(0, 0, marker="v", color=style.INK, markersize=6, linestyle="none", clip_on=False, zorder=5,
              label="contact")
    for name, moments, inside in (("solid", run["body"]["solid"], "white"),
                                  ("optimised", run["solve"]["moments"], style.VERMILION)):
        x, _, z = centre(moments) * slab.mm
        axes.plot(x, z, marker="o", markersize=7, linestyle="none", markeredgecolor=style.VERMILION,
                  markerfacecolor=inside, zorder=5, label=f"centre of mass, {name}")


def draw(run, slab):
    left, right = slab.x.min() - slab.cell / 2, slab.x.max() + slab.cell / 2
    bottom, top = min(0.0, slab.low.min()), slab.high.max()
    pad = 0.04 * max(right - left, top - bottom)
    left, right, bottom, top = left - pad, right + pad, bottom - pad, top + pad
    width = right - left
    # Placed by hand, in inches: the automatic layouts let an axes of fixed aspect run over its labels.
    across = min(5.4, 7.0 * width / (top - bottom))
    up = across * (top - bottom) / width
    wide, high = max(across + 2.9, 7.0), up + 1.45
    figure = plt.figure(figsize=(wide, high))
    axes = figure.add_axes((0.65 / wide, 1.05 / high, across / wide, up / high))
    axes.grid(False)
    files = written(run)
    if len(files) > 1:
        handles = draw_materials(axes, slab, files)
        if "filling" not in files:
            handles.append(Patch(facecolor="white", edgecolor=style.QUIET, label="void"))
    else:
        draw_interior(axes, slab)
        handles = [Patch(color=style.SOLID, label="interior left solid"), Patch(color=style.VOID, label="void")]
    for material in files.values():
        lines = outline(run, material["path"], slab.y)
        axes.add_collection(LineCollection(lines, colors=style.INK, linewidths=0.7, zorder=3))
        left, bottom = np.minimum((left, bottom), lines.min(axis=(0, 1)) - pad)
        right, top = np.maximum((right, top), lines.max(axis=(0, 1)) + pad)
    draw_marks(axes, slab)
    axes.set(aspect="equal", xlim=(left, right), ylim=(bottom, top), xlabel="x in mm, body frame",
             ylabel="z along the axis in mm")
    grid = "×".join(str(n) for n in run["domain"]["grid"])
    axes.set_title(f"{run['model']}, {run['problem']}, {run['formulation']} on {grid}: "
                   f"f = {run['objective']:.5g} ({run['termination']})")
    marks, _ = axes.get_legend_handles_labels()
    axes.legend(handles=handles + marks, loc="upper left", bbox_to_anchor=(1.01, 1), fontsize=8)
    hessian = run["config"].get("ipopt.hessian_approximation", "exact")
    how = f"{run['solver']}, Hessian {hessian}" if run["solver"] == "ipopt" else run["solver"]
    shell = "the shell is not drawn" if not files else "lines: surfaces of the written part"
    note = (f"Cut at y = {slab.y:.3g} mm; {shell}; centres of mass are projected onto the "
            f"plane. {how}. Verified part: {run['verified']['text']}. "
            f"{records.provenance_line([run])}.")
    style.caption(figure, note)
    return figure


def main():
    args = arguments()
    run = records.read(args.record)
    if "error" in run:
        reason = run["error"].partition("\n")[0]
        raise records.BadRecord(f"{args.record}: a failed run ({reason}), expected a result")
    if run["formulation"] not in ("rayrep", "voxel", "octree", "quadric") or len(run["domain"]["intervals"]) == 0:
        raise records.BadRecord(f"{args.record}: no interior to cut, expected a ray-rep, voxel, octree or quadric run")
    records.save(draw(run, Slab(run, row_to_cut(run, args.row))), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
