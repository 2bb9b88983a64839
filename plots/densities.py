#!/usr/bin/python3
"""What does a heavier interior gain? Objective, and whether the part does what was asked, against its density."""

import records
import walls


def density(run):
    return run["body"]["interior_density"]


def figure(found, _published=None):
    return walls.sweep(found, density, "density of the interior, g/cm³", left=None, scale="log")


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "densities"))
