#!/usr/bin/python3
"""What does a heavier interior gain? Objective, and whether the part does what was asked, against its density."""

import records
import walls


def figure(found, _published=None):
    return walls.sweep(found, "interior_density", "density of the interior, g/cm³", left=None, scale="log")


if __name__ == "__main__":
    records.main_with(lambda: records.draw_folder(figure, __doc__, "densities"))
