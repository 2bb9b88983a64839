#!/usr/bin/python3
"""Does a search's record hold what results/README.md says? Usage: nest_h5py_test.py NESTING.h5; exit status 1 when not."""

import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "r") as file:
    at = file.attrs
    assert at["schema"] == "kreisel nesting" and at["schema_version"] == 1
    assert at["kind"] == "swarm" and at["termination"] == "valid" and at["valid"] == 1
    assert at["shapes"] == "small in large"
    trace = file["trace"]
    assert list(trace.attrs["columns"]) == ["iteration", "evaluations", "best", "mean", "feasible", "seconds"]
    rows = trace[...]
    assert (np.diff(rows[:, 0]) == 1).all() and (np.diff(rows[:, 1]) > 0).all()
    best = rows[np.isfinite(rows[:, 2]), 2]
    assert (np.diff(best) >= 0).all() and best[-1] == at["scale"]
    assert rows[-1, 1] == at["evaluations"] and (np.diff(rows[:, 5]) >= 0).all()
    place = file["placement"]
    transform = place["transform"][...]
    turn = transform[:, :3] / at["scale"]
    assert transform.shape == (3, 4) and np.allclose(turn @ turn.T, np.eye(3)) and np.linalg.det(turn) > 0
    normal = place["plane_normal"][...]
    assert np.dot(normal, place["removal_plus"][...]) > 0 > np.dot(normal, place["removal_minus"][...])
    # The inner cube, corner by corner, lies in the outer one.
    corners = 2.0 * np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    placed = corners @ transform[:, :3].T + transform[:, 3]
    assert (placed > 0).all() and (placed < 4).all()
    # Walls along the removal direction: what is sampled errs either way, by a part of a pixel.
    assert at["certified_scale"] >= at["scale"] and abs(at["sampled_scale"] - at["scale"]) < 2 * 4 / 512
    assert file["config"].attrs["free"] == "position,removal" and file["provenance"].attrs["commit"]
