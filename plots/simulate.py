#!/usr/bin/python3
"""What physics says of a part beside the solid it was made of: motion, spectrum, righting arm or toppling angle."""

import argparse
import pathlib

import h5py
import numpy as np

import records
import style
from style import plt

SCHEMA, NEWEST = "kreisel simulation", 1
BODIES = (("solid", "solid", style.VERMILION), ("part", "part", style.BLUE))


def _group(group):
    found = {name: value.item() if hasattr(value, "item") else value for name, value in group.attrs.items()}
    for name, node in group.items():
        found[name] = node[...] if isinstance(node, h5py.Dataset) else _group(node)
    return found


def read(path):
    """A simulation as nested dicts: attributes, datasets and groups by name."""
    path = pathlib.Path(path)
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != SCHEMA or not 1 <= file.attrs.get("schema_version", 0) <= NEWEST:
                raise records.BadRecord(f"{path}: not a simulation, expected schema = {SCHEMA}, version 1 to {NEWEST}")
            return _group(file)
    except OSError:
        reason = "not readable as HDF5" if path.exists() else "no such file"
        raise records.BadRecord(f"{path}: {reason}, expected what bench simulate --record wrote") from None


def bodies(found, kind):
    """(label, colour, what was simulated) of each body."""
    shown = BODIES if found["hollow"] else BODIES[:1]
    return [(label, colour, {**found[name], **found[name][kind]}) for name, label, colour in shown if kind in found[name]]


def draw_motion(axes, found):
    for label, colour, body in bodies(found, "spin"):
        time, tilt = body["motion"].T
        axes.plot(time, tilt, color=colour, linewidth=0.9, label=label)
        if not np.isnan(body["fell_at"]):
            axes.plot(time[-1], tilt[-1], "x", color=colour)
            axes.annotate(" fallen", (time[-1], tilt[-1]), color=colour, fontsize=8, va="top")
    axes.set_yscale("log")
    axes.set_title(f"tilt of the axis, degrees, at {found['rpm']:.0f} rpm")
    axes.set_xlabel("s")
    axes.legend(fontsize=8)


def draw_scan(upper, lower, found):
    for i, (label, colour, body) in enumerate(bodies(found, "spin")):
        rpm, growth, _, tilt, _ = body["scan"].T
        upper.plot(rpm, tilt, color=colour, linewidth=1.2, marker="o", markersize=2, label=label)
        lower.plot(rpm, np.where(growth > 0, growth, np.nan), color=colour, linewidth=1.2, label=label)
        below = -(1 + i) * 0.05 * np.nanmax(found["solid"]["spin"]["scan"][:, 1])
        lower.plot(rpm, np.where(growth == 0, below, np.nan), color=colour, linewidth=4, solid_capstyle="butt")
        eq1 = body["values"]["omega_min_rpm"]
        for axes in (upper, lower):
            if np.isfinite(eq1):
                axes.axvline(eq1, color=colour, linewidth=0.9, linestyle=style.LINES[2])
    for axes in (upper, lower):
        axes.axvline(found["rpm"], color=style.QUIET, linewidth=0.8)
        axes.set_xlim(0, rpm[-1])
        axes.set_xlabel("rpm")
    upper.set_title(f"largest tilt within {found['seconds']:g} s, degrees")
    upper.set_yscale("log")
    lower.set_title("growth of a small wobble, 1/s")


def spin_figure(found):
    scanned = "scan" in found["solid"]["spin"]
    if not scanned:
        figure, panel = plt.subplots(figsize=(7, 3.6))
        draw_motion(panel, found)
        marks = ""
    else:
        figure, panels = plt.subplots(1, 3, figsize=(12, 3.8))
        draw_motion(panels[0], found)
        draw_scan(panels[1], panels[2], found)
        marks = ("; bands: stable by the spectrum; dotted: SpinIt's eq. 1; grey line: the speed on the left; neither "
                 "curve nor band where there is no steady spin within 10 degrees of the axis")
    contact = {"held": "the tip held in place", "gliding": "the tip gliding without friction", "free": "in free fall"}
    return figure, (f"{found['model']}, {contact[found['contact']]}, from a tilt of {found['tilt_degrees']:g} degrees{marks}. "
                    + records.provenance_line([found]))


def float_figure(found):
    figure, panels = plt.subplots(1, 2, figsize=(9.5, 3.8), sharey=True)
    for axes, name, title in zip(panels, ("least", "across"), ("about the axis of least stability", "and across it")):
        for label, colour, body in bodies(found, "float"):
            curve = body[name]
            heel, gz = curve["curve"].T
            axes.plot(heel, gz, color=colour, linewidth=1.3, label=label)
            slope = curve["metacentric_height_mm"]
            reach = np.linspace(0, 40, 2)
            axes.plot(reach, slope * np.radians(reach), color=colour, linewidth=0.8, linestyle=style.LINES[2])
            if not np.isnan(curve["vanishing_degrees"]):
                axes.plot(curve["vanishing_degrees"], 0, "o", color=colour, markersize=4)
        axes.axhline(0, color=style.INK, linewidth=0.8)
        axes.set_title(f"righting arm, mm, {title}" if axes is panels[0] else title)
        axes.set_xlabel("heel, degrees")
    low = min(body[name]["curve"][:, 1].min() for _, _, body in bodies(found, "float") for name in ("least", "across"))
    high = max(body[name]["curve"][:, 1].max() for _, _, body in bodies(found, "float") for name in ("least", "across"))
    panels[0].set_ylim(1.1 * low, 1.25 * high)
    panels[0].legend(fontsize=8)
    return figure, (f"{found['model']}, afloat; dotted: metacentric height times heel; dots: where stability vanishes. "
                    + records.provenance_line([found]))


def stand_figure(found):
    figure, axes = plt.subplots(figsize=(4.6, 4.8), subplot_kw={"projection": "polar"})
    for label, colour, body in bodies(found, "stand"):
        azimuth, angle = body["toppling"].T
        axes.plot(np.radians(np.append(azimuth, azimuth[0])), np.append(angle, angle[0]), color=colour, linewidth=1.4,
                  label=label)
    axes.set_title("tilt of the ground at which it topples, degrees,\nby the downhill direction", fontsize=9, pad=14)
    axes.legend(fontsize=8, loc="lower left", bbox_to_anchor=(-0.1, -0.08))
    return figure, f"{found['model']}, standing. " + records.provenance_line([found])


FIGURES = {"spin": spin_figure, "float": float_figure, "stand": stand_figure}


def drawn(found, name):
    """The figure of one simulation, with its caption. name: what it was read from."""
    kind = next((kind for kind in FIGURES if kind in found["part"]), None)
    if kind is None:
        raise records.BadRecord(f"{name}: nothing to draw, expected one of {', '.join(FIGURES)}")
    figure, text = FIGURES[kind](found)
    low = style.caption(figure, text)
    figure.tight_layout(rect=(0, low, 1, 1))
    return figure


def figures(found, _published):
    """For report.py: a figure each of the runs that `bench report` has simulated."""
    simulated = [run["simulation"] for run in found if run.get("simulation")]
    if not simulated:
        raise records.BadRecord("no part of these runs can be set in motion")
    return [drawn(read(path), path) for path in simulated]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", help="HDF5 file that bench simulate --record wrote")
    parser.add_argument("-o", "--output", default="simulate.png", help="PNG to write (default %(default)s)")
    args = parser.parse_args()
    figure = drawn(read(args.record), args.record)
    records.save(figure, args.output)
    print(args.output)


if __name__ == "__main__":
    records.main_with(main)
