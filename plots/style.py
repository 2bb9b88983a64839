"""Colours and settings that the figures share."""

import textwrap

import matplotlib

matplotlib.use("Agg")  # files only: works without a display
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

INK, QUIET, GRID = "#1f2328", "#6b7280", "#e5e7eb"
# Told apart by any eyes, and in grey: Okabe and Ito's blue and vermilion.
BLUE, VERMILION = "#0072B2", "#D55E00"
# The rest of theirs, for series beyond two.
COLOURS = (BLUE, VERMILION, "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = "osD^vP*"
LINES = ("-", (0, (5, 2)), (0, (1.2, 1.5)), (0, (6, 2, 1.2, 2)))
SOLID, VOID = "#3f6f9f", "#e8eef4"

plt.rcParams.update({
    "font.size": 9, "axes.titlesize": 10, "axes.titleweight": "bold", "axes.titlelocation": "left",
    "axes.edgecolor": QUIET, "axes.labelcolor": INK, "axes.spines.top": False, "axes.spines.right": False,
    "axes.grid": True, "axes.axisbelow": True, "grid.color": GRID, "xtick.color": QUIET, "ytick.color": QUIET,
    "xtick.labelcolor": INK, "ytick.labelcolor": INK, "legend.frameon": False, "text.color": INK,
})


def log_seconds(axes):
    """A logarithmic x axis whose ticks are plain numbers: 0.1 0.2 0.5 1 2 5 ..."""
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    low, high = low / 1.15, high * 1.15
    ticks = [m * 10.0 ** e for e in range(-4, 6) for m in (1, 2, 5) if low <= m * 10.0 ** e <= high]
    if len(ticks) > 8:
        ticks = [t for t in ticks if f"{t:e}"[0] == "1"]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.minorticks_off()
    axes.set_xlim(low, high)


def caption(figure, text, characters=None):
    """Small print along the lower edge, wrapped to the figure's width. Returns its upper end, 0 to 1."""
    characters = characters or int(figure.get_figwidth() * 19)
    lines = textwrap.wrap(text, characters)
    figure.text(0.01, 0.012, "\n".join(lines), fontsize=7, color=QUIET, va="bottom", ha="left")
    return (0.012 * figure.get_figheight() + 0.115 * len(lines)) / figure.get_figheight()
