#!/usr/bin/python3
"""Every orientation of a body on one picture: about which axes it can spin, or on which sides it floats.

Maps of one case each, as those of spin, may share a picture: name several.
"""

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


def values_of(found):
    """What the colours have to tell apart; pale ones may saturate."""
    values = found["shown"][found["ok"] == 1]
    return values if len(values) else found["shown"][found["feasible"] == 1]


def scale_of(found):
    """Normalisation and colours."""
    _, _, _, name, more = DRAWN[found["problem"]]
    values = values_of(found)
    # A few extreme axes, such as those of flat slivers, would take all colours from the rest.
    low, high = np.percentile(values, [0, 95] if not more else [5, 100]) if len(values) else (0, 1)
    return plt.Normalize(low, high if high > low else low + 1, clip=True), plt.get_cmap(name)


def through_text(found):
    if found["problem"] != "spin":
        return ""
    return "through the solid's centre of mass" if found["through"] == "centre" else "through the lowest point"


def legend(result, maps, lower):
    words, colours = DRAWN[maps[0]["problem"]][2], scale_of(maps[0])[1]
    handles = [Patch(facecolor=colours(0.6), label=words),
               Patch(facecolor=colours(0.6), alpha=0.35, label=f"feasible, yet does not {words[:-1]}"),
               Patch(facecolor=FAR, edgecolor="#d1d5db", hatch="////", linewidth=0,
                     label="infeasible (darker: farther off)")]
    if any((found["feasible"] == -1).any() for found in maps):
        handles.append(Patch(facecolor=UNDECIDED, edgecolor=style.QUIET, linewidth=0.5, label="undecided"))
    if any(found["best_axis"] >= 0 for found in maps):
        handles.append(Line2D([], [], marker="*", markersize=11, linestyle="", color=style.VERMILION,
                              markeredgecolor="white", label="best"))
    result.legend(handles=handles, loc="lower center", ncols=len(handles), bbox_to_anchor=(0.5, lower + 0.01),
                  fontsize=8)


def figure(found):
    """All cases of one map."""
    cases = len(found["cases"])
    columns = 1 if cases == 1 else 2
    rows = -(-cases // columns)
    result, panels = plt.subplots(rows, columns, figsize=(7.4, 4.7) if columns == 1 else (11, 2.9 * rows + 1.2),
                                  squeeze=False)
    norm, colours = scale_of(found)
    index = nearest(found["axes"])
    for panel in panels.flat[cases:]:
        panel.axis("off")
    for at_case, panel in zip(range(cases), panels.flat):
        draw(panel, found, at_case, index, colours, norm)
    result.suptitle(f"{found['model']}: where it can {found['problem']}", x=0.01, ha="left", fontweight="bold")
    axis = "spin axis " + through_text(found) if found["problem"] == "spin" else "up axis"
    lower = style.caption(result, f"Direction of the {axis} in the model's coordinates, Mollweide's equal-area projection; "
                          f"grid {found['config']['resolution']}, wall {found['config']['wall']}; "
                          f"{found['sweep_seconds']:.1f} s. " + records.provenance_line([found]))
    known = len(values_of(found)) > 0
    if known:
        _, label, _, _, more = DRAWN[found["problem"]]
        bar = result.colorbar(plt.cm.ScalarMappable(norm, colours), cax=result.add_axes((0.885, 0.3, 0.015, 0.45)),
                              extend="min" if more else "max")
        bar.set_label(label)
        bar.outline.set_visible(False)
    legend(result, [found], lower)
    result.subplots_adjust(left=0.02, right=0.86 if known else 0.98, top=0.86 if rows == 1 else 0.9,
                           bottom=lower + 0.08, hspace=0.12, wspace=0.03)
    return result


def figures(maps, _published=None):
    """A picture a map, for `bench report`."""
    return [figure(found) for found in maps if len(found.get("axes", ()))]


def together(maps):
    """Maps of one case each, two across, the colours of each on a scale of its own."""
    down = -(-len(maps) // 2)
    result, panels = plt.subplots(down, 2, figsize=(11, 2.95 * down + 1.1), squeeze=False)
    for panel in panels.flat:
        panel.axis("off")
    for found, panel in zip(maps, panels.flat):
        norm, colours = scale_of(found)
        draw(panel, found, 0, nearest(found["axes"]), colours, norm)
        values = values_of(found)
        best = f"; f from {values.min():.3f}" if len(values) and not DRAWN[found["problem"]][4] else ""
        panel.set_title(f"{found['model']}: {panel.get_title('left')}{best}", fontsize=8.5)
    places = sorted({through_text(found) for found in maps})
    result.suptitle(f"Where they can {maps[0]['problem']}", x=0.01, ha="left", fontweight="bold")
    lower = style.caption(result, f"Direction of the axis ({', '.join(places)}) in each model's coordinates, Mollweide's "
                          "equal-area projection; yellow is best, each body on a scale of its own. "
                          + records.provenance_line(maps))
    legend(result, maps, lower)
    result.subplots_adjust(left=0.02, right=0.98, top=0.92, bottom=lower + 0.06, hspace=0.14, wspace=0.03)
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", nargs="+", help="HDF5 files that bench map --record or bench run wrote")
    parser.add_argument("-o", "--output", default="map.png", help="PNG to write (default %(default)s)")
    args = parser.parse_args()
    maps = [read(path) for path in args.record]
    for path, found in zip(args.record, maps):
        if not len(found["axes"]):
            raise records.BadRecord(f"{path}: no axis in it, expected a sweep that had begun")
        if len(maps) > 1 and (len(found["cases"]) > 1 or found["problem"] != maps[0]["problem"]):
            raise records.BadRecord(f"{path}: not of one case or another problem, expected maps that share a picture")
    records.save(figure(maps[0]) if len(maps) == 1 else together(maps), args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
