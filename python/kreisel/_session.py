"""The compiled part, and what of a session is better said in Python."""

import numpy as np

from . import _core
from ._core import (Body, Device, Error, InputError, Inspection, Iteration, Mending, Nesting, Part, Question, Shell,
                    Solid, Solution, Verdict, add_problem, inspect, nest, question_fields, verify)

__all__ = ["Body", "Device", "Error", "InputError", "Inspection", "Iteration", "Map", "Mending", "Nesting", "Part",
           "Place", "Question", "Session", "Shell", "Solid", "Solution", "Verdict", "add_problem", "inspect", "nest",
           "question_fields", "verify"]


class Place:
    """One axis of a map."""

    def __init__(self, session, map_, index):
        self.index = index
        self.question = map_.question(index)
        self._session = session

    @property
    def solution(self):
        """The question of this axis, solved by the session."""
        return self._session.solve(self.question)


class Map:
    """Every orientation over one domain. axes, contacts (n, 3); feasible, ok, objective (n,)."""

    def __init__(self, session, found):
        self._session, self._found = session, found
        self.axes = np.asarray(found.axes).reshape(-1, 3)
        self.contacts = np.asarray(found.contacts).reshape(-1, 3)
        self.feasible = np.asarray(found.feasible, dtype=bool)
        self.ok = np.asarray(found.ok, dtype=bool)
        self.objective = np.asarray(found.objective, dtype=float)

    def __len__(self):
        return len(self.axes)

    def at(self, index):
        """One axis of the map."""
        return Place(self._session, self._found, index)

    def best(self):
        """The best axis that does what was asked, else the best that is feasible; None where none is."""
        return None if self._found.best_index is None else self.at(self._found.best_index)


class Session(_core.Session):
    """A body with its domain, kept between questions: each makes anew only what it changes (made).

    One thread at a time; sessions in several threads are independent.
    """

    def map(self, question="spin", *, axes=2000, through="lowest", **fields):
        """Solves every one of so many directions of the sphere, for spin or float.

        through: "lowest", the axis runs through the lowest point; "centre", through the solid's centre of mass.
        """
        if through not in ("lowest", "centre"):
            raise InputError(f"through = {through!r}; expected 'lowest' or 'centre'")
        return Map(self, self._map(question, axes, through == "centre", **fields))
