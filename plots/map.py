#!/usr/bin/python3
"""Every orientation of a body on one picture: about which axes it can spin, or on which sides it floats."""

import argparse
import pathlib

import h5py
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, to_rgba
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import records
import style
from style import plt

SCHEMA, NEWEST = "kreisel map", 1
# Infeasible axes, from hardly missed to far off.
NEAR, FAR, UNDECIDED = "#f3f4f6", "#9ca3af", "#ffffff"
# What is drawn of each problem: dataset, its label, the words for a good verdict, colours, is more better?
DRAWN = {
    "spin": ("objective", "objective f (less is better)", "spins", "viridis_r", False),
    "float": ("values/metacentric_height_mm", "metacentric height, mm", "floats", "viridis", True),
}


def read(path):
    """A map as a dict: attributes, axes [n, 3], and feasible, ok, shown of [n, cases] each."""
    path = pathlib.Path(path)
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != SCHEMA or not 1 <= file.attrs.get("schema_version", 0) <= NEWEST:
                raise records.BadRecord(f"{path}: not a map, expected schema = {SCHEMA}, version 1 to {NEWEST}")
            found = {name: value.item() if hasattr(value, "item") else value for name, value in file.attrs.items()}
            found["cases"] = found["cases"].split("\n")
            for name in ("axes", "feasible", "ok", "miss"):
                found[name] = file[name][...]
            drawn = DRAWN[found["problem"]][0]
            found["shown"] = file[drawn][...] if drawn in file else np.full(found["ok"].shape, np.nan)
            found["provenance"] = dict(file["provenance"].attrs)
            found["config"] = dict(file["config"].attrs)
            return found
    except OSError:
        reason = "not readable as HDF5" if path.exists() else "no such file"
        raise records.BadRecord(f"{path}: {reason}, expected what bench map --record wrote") from None


def to_map(direction):
    """Mollweide's equal-area projection, east to the right. direction [..., 3] -> x [-2, 2], y [-1, 1]."""
    direction = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
    latitude, longitude = np.arcsin(direction[..., 2]), np.arctan2(direction[..., 1], direction[..., 0])
    theta = latitude.copy()
    for _ in range(60):  # 2 t + sin 2t = pi sin(latitude); Newton's method is slow, yet sure, at the poles
        slope = np.maximum(2 + 2 * np.cos(2 * theta), 1e-9)
        theta = np.clip(theta - (2 * theta + np.sin(2 * theta) - np.pi * np.sin(latitude)) / slope,
                        -np.pi / 2, np.pi / 2)
    return 2 * longitude / np.pi * np.cos(theta), np.sin(theta)


def directions_of(width):
    """The direction that each pixel of the map shows, [height, width, 3]; NaN outside the ellipse."""
    x, y = np.meshgrid(2 * (np.arange(width) + 0.5) / width * 2 - 2, 2 * (np.arange(width // 2) + 0.5) / (width // 2) - 1)
    inside = (x / 2) ** 2 + y ** 2 < 1
    theta = np.arcsin(y)
    latitude = np.arcsin(np.clip((2 * theta + np.sin(2 * theta)) / np.pi, -1, 1))
    longitude = np.pi * x / (2 * np.maximum(np.cos(theta), 1e-12))
    direction = np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude),
                          np.sin(latitude)], axis=-1)
    return np.where(inside[..., None], direction, np.nan)


def nearest(axes, width=720):
    """Index of the axis nearest to each pixel's direction, [height, width]; -1 outside."""
    pixels = directions_of(width)
    index = np.full(pixels.shape[:2], -1)
    for row, line in enumerate(pixels):
        known = ~np.isnan(line[:, 0])
        index[row, known] = np.argmax(line[known] @ axes.T, axis=1)
    return index


def greys(found):
    """Colour of each infeasible axis by its miss, [n, cases, 4]."""
    missed = found["miss"][found["feasible"] == 0]
    scale = plt.Normalize(0, np.percentile(missed, 95) if len(missed) else 1, clip=True)
    return LinearSegmentedColormap.from_list("miss", [NEAR, FAR])(scale(np.nan_to_num(found["miss"])))


def draw(axes, found, at_case, index, colours, norm):
    """One case: colours where feasible, dots where the verdict is bad all the same, grey hatching elsewhere."""
    feasible, ok, shown = (found[name][:, at_case] for name in ("feasible", "ok", "shown"))
    extent = (-2, 2, -1, 1)
    rgba = colours(norm(np.where(feasible == 1, shown, 0)))
    rgba[feasible == 1, 3] = np.where(ok[feasible == 1], 1, 0.35)
    rgba[feasible == 0] = greys(found)[feasible == 0, at_case]
    rgba[feasible == -1] = to_rgba(UNDECIDED)
    image = np.where((index >= 0)[..., None], rgba[index], [1, 1, 1, 0])
    axes.imshow(image, extent=extent, origin="lower", interpolation="nearest", aspect="equal")
    x = np.linspace(-2, 2, index.shape[1] + 1)[:-1] + 2 / index.shape[1]
    y = np.linspace(-1, 1, index.shape[0] + 1)[:-1] + 1 / index.shape[0]
    out = np.where(index >= 0, feasible[index] == 0, False)
    if out.any():
        with plt.rc_context({"hatch.color": "#d1d5db", "hatch.linewidth": 0.5}):
            axes.contourf(x, y, out.astype(float), levels=[0.5, 1.5], colors="none", hatches=["////"])
    turn = np.linspace(0, 2 * np.pi, 200)
    axes.plot(2 * np.cos(turn), np.sin(turn), color=style.QUIET, linewidth=0.8)
    for name, direction in (("+x", (1, 0, 0)), ("+y", (0, 1, 0)), ("−y", (0, -1, 0)), ("+z", (0, 0, 1)),
                            ("−z", (0, 0, -1)), ("−x", (-1, 1e-9, 0)), ("−x", (-1, -1e-9, 0))):
        px, py = (float(v) for v in to_map(np.array(direction, float)))
        rim = abs(px) > 1.9 or abs(py) > 0.9
        axes.annotate(name, (px * (1.07 if rim else 1), py * (1.1 if rim else 1)), fontsize=8, ha="center",
                      va="center", color=style.INK, bbox=None if rim else
                      dict(boxstyle="round,pad=0.15", facecolor="white", edgecolor="none", alpha=0.6))
    if found["best_case"] == at_case:
        px, py = to_map(found["axes"][found["best_axis"]])
        axes.plot(px, py, marker="*", markersize=15, color=style.VERMILION, markeredgecolor="white", clip_on=False)
    axes.set_xlim(-2.2, 2.2)
    axes.set_ylim(-1.18, 1.18)
    axes.axis("off")
    n = len(feasible)
    words = DRAWN[found["problem"]][2]
    title = f"draft {found['cases'][at_case]}: " if found["cases"][at_case] else ""
    axes.set_title(f"{title}{np.mean(feasible == 1):.1%} of {n} axes feasible, {np.mean(ok == 1):.1%} {words[:-1]}",
                   fontsize=9)


def figure(found):
    cases = len(found["cases"])
    columns = 1 if cases == 1 else 2
    rows = -(-cases // columns)
    result, panels = plt.subplots(rows, columns, figsize=(7.4, 4.7) if columns == 1 else (11, 2.9 * rows + 1.2),
                                  squeeze=False)
    _, label, words, name, more = DRAWN[found["problem"]]
    colours = plt.get_cmap(name)
    values = found["shown"][found["ok"] == 1]  # pale colours may saturate
    if not len(values):
        values = found["shown"][found["feasible"] == 1]
    # A few extreme axes, such as those of flat slivers, would take all colours from the rest.
    low, high = np.percentile(values, [0, 95] if not more else [5, 100]) if len(values) else (0, 1)
    norm = plt.Normalize(low, high if high > low else low + 1, clip=True)
    index = nearest(found["axes"])
    for panel in panels.flat[cases:]:
        panel.axis("off")
    for at_case, panel in zip(range(cases), panels.flat):
        draw(panel, found, at_case, index, colours, norm)
    result.suptitle(f"{found['model']}: where it can {found['problem']}", x=0.01, ha="left", fontweight="bold")
    through = "" if found["problem"] != "spin" else (
        " through the solid's centre of mass" if found["through"] == "centre" else " through the lowest point")
    lower = style.caption(result, f"Direction of the {'spin' if found['problem'] == 'spin' else 'up'} axis{through} in the "
                          f"model's coordinates, Mollweide's equal-area projection; grid {found['config']['resolution']}, "
                          f"wall {found['config']['wall']}; {found['sweep_seconds']:.1f} s. "
                          + records.provenance_line([found]))
    if len(values):
        bar = result.colorbar(plt.cm.ScalarMappable(norm, colours), cax=result.add_axes((0.885, 0.3, 0.015, 0.45)),
                              extend="min" if more else "max")
        bar.set_label(label)
        bar.outline.set_visible(False)
    handles = [Patch(facecolor=colours(0.6), label=words),
               Patch(facecolor=colours(0.6), alpha=0.35, label=f"feasible, yet does not {words[:-1]}"),
               Patch(facecolor=FAR, edgecolor="#d1d5db", hatch="////", linewidth=0,
                     label="infeasible (darker: farther off)")]
    if (found["feasible"] == -1).any():
        handles.append(Patch(facecolor=UNDECIDED, edgecolor=style.QUIET, linewidth=0.5, label="undecided"))
    if found["best_axis"] >= 0:
        handles.append(Line2D([], [], marker="*", markersize=11, linestyle="", color=style.VERMILION,
                              markeredgecolor="white", label="best"))
    result.legend(handles=handles, loc="lower center", ncols=len(handles), bbox_to_anchor=(0.5, lower + 0.01),
                  fontsize=8)
    result.subplots_adjust(left=0.02, right=0.86 if len(values) else 0.98, top=0.86 if rows == 1 else 0.9,
                           bottom=lower + 0.08, hspace=0.12, wspace=0.03)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", help="HDF5 file that bench map --record wrote")
    parser.add_argument("-o", "--output", default="map.png", help="PNG to write (default %(default)s)")
    args = parser.parse_args()
    found = read(args.record)
    if not len(found["axes"]):
        raise records.BadRecord(f"{args.record}: no axis in it, expected a sweep that had begun")
    records.save(figure(found), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
