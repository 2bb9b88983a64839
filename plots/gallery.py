#!/usr/bin/python3
"""Stills of the pages that `design --html` writes, side by side: by a browser without a screen."""

import argparse
import pathlib
import subprocess
import tempfile

from style import plt

WIDTH, HEIGHT = 800, 760


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", nargs="+", help="PAGE.html[#cut=0.5&turn=0.4]=caption")
    parser.add_argument("-o", "--output", default="gallery.png", help="PNG to write (default %(default)s)")
    parser.add_argument("--browser", default="chromium")
    return parser.parse_args()


def still(browser, page, view, folder):
    """The view of a page and nothing else, as an image."""
    shot = pathlib.Path(folder) / "still.png"
    subprocess.run([browser, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                    f"--user-data-dir={folder}/profile", f"--window-size={WIDTH},{HEIGHT}",
                    "--virtual-time-budget=20000",  # a page unpacks itself before it draws
                    f"--screenshot={shot}", f"file://{pathlib.Path(page).resolve()}#picture&{view}"],
                   check=True, capture_output=True)
    return plt.imread(shot)


def main():
    options = arguments()
    columns = min(3, len(options.pages))
    rows = -(-len(options.pages) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.2 * columns, 3.3 * rows), squeeze=False)
    with tempfile.TemporaryDirectory() as folder:
        for ax, given in zip(axes.flat, options.pages):
            page, _, caption = given.rpartition("=")
            page, _, view = page.partition("#")
            ax.imshow(still(options.browser, page, view, folder))
            ax.set_title(caption, fontsize=9)
    for ax in axes.flat:
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(options.output, dpi=110)


if __name__ == "__main__":
    main()
