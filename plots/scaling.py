#!/usr/bin/python3
"""How does the time of a solve grow with the count of rays? Log-log, a panel a body, with the fitted exponents."""

import numpy as np

import formulations
import records
from style import plt  # noqa: F401  (sets the style)

LEAST = 3  # points of a fit


def exponent(line):
    """(p, factor) of seconds = factor rays^p by least squares of the logarithms, or None for too few points."""
    rays = np.array([run["rays"] for run in line], float)
    if len(set(rays)) < LEAST:
        return None
    p, c = np.polyfit(np.log(rays), np.log([run["seconds"] for run in line]), 1)
    return p, np.exp(c)


def draw_panel(axes, model, ways):
    axes.set_title(model)
    texts = []
    for key, line in sorted(ways.items(), key=lambda item: list(formulations.LOOKS).index(item[0])):
        name, colour, marker = formulations.LOOKS[key]
        rays = np.array([run["rays"] for run in line], float)
        fit = exponent(line)
        axes.plot(rays, [run["seconds"] for run in line], color=colour, marker=marker, markersize=4.5,
                  linewidth=0.8, linestyle="none" if fit else ":", label=name,
                  markerfacecolor="none" if key.endswith(formulations.MUMPS) else colour)
        if fit:
            ends = np.array([rays.min(), rays.max()])
            axes.plot(ends, fit[1] * ends ** fit[0], color=colour, linewidth=1.2)
            texts.append((f"{'MUMPS ' if key.endswith(formulations.MUMPS) else ''}rays$^{{{fit[0]:.2f}}}$", colour))
    axes.set_xscale("log")
    axes.set_yscale("log")
    for row, (text, colour) in enumerate(texts):
        axes.text(0.97, 0.97 - 0.085 * row, text, transform=axes.transAxes, color=colour, va="top", ha="right", fontsize=9)
    low, high = axes.get_ylim()
    axes.set_ylim(low, high * 4)  # room for the exponents
    axes.set_xlabel("rays")


def figure(found, _published=None):
    lines, left_out = formulations.by_way(found)
    fig, panels = formulations.panels_for(len(lines))
    for axes, (model, ways) in zip(panels, lines.items()):
        draw_panel(axes, model, ways)
    panels[0].set_ylabel("seconds of the solve")
    runs = [run for ways in lines.values() for line in ways.values() for run in line]
    return formulations.finish(fig, panels, f"Exponents: least squares of the logarithms, of {LEAST} grids or more.",
                               runs, left_out)


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "scaling"))
