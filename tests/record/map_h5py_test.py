#!/usr/bin/python3
"""Does a map hold what results/README.md says? Usage: map_h5py_test.py MAP.h5; exit status 1 when not."""

import sys

import h5py
import numpy as np

SPIN = {"off_axis", "off_axis_mm", "tilt_degrees", "largest_over_lateral", "omega_min_rpm", "centre_of_mass_z_mm",
        "gliding_stable_above_rpm", "held_stable_above_rpm", "objective"}

with h5py.File(sys.argv[1], "r") as file:
    at = file.attrs
    assert at["schema"] == "kreisel map" and at["schema_version"] == 1
    assert at["through"] in ("lowest", "centre")
    axes, feasible, ok = file["axes"][...], file["feasible"][...], file["ok"][...]
    cases = at["cases"].split("\n")
    n, shape = len(axes), (len(axes), len(cases))
    assert 0 < n <= at["axes_asked"] and at["complete"] == (n == at["axes_asked"])
    assert axes.shape == file["contacts"].shape == (n, 3)
    assert np.allclose(np.linalg.norm(axes, axis=1), 1)
    assert feasible.shape == ok.shape == file["objective"].shape == file["miss"].shape == shape
    assert set(np.unique(feasible)) <= {-1, 0, 1} and set(np.unique(ok)) <= {0, 1}
    assert (feasible[ok == 1] == 1).all()
    assert (np.isfinite(file["objective"][...]) == (feasible == 1)).all()
    assert (file["miss"][...][feasible == 1] == 0).all() and (file["miss"][...][feasible == 0] > 0).all()
    assert file["axes"].attrs["units"] == "1" and file["contacts"].attrs["units"] == "mm"
    for name, values in file["values"].items():
        assert values.shape == shape and (np.isnan(values[...]) | (feasible == 1)).all(), name
    if at["problem"] == "spin" and (feasible == 1).any():
        assert set(file["values"]) == SPIN, set(file["values"])
        assert file["values/omega_min_rpm"].attrs["units"] == "1/min"
        # One that spins has the largest moment about its axis.
        assert (file["values/largest_over_lateral"][...][ok == 1] > 1).all()
    best = at["best_axis"], at["best_case"]
    assert (best[0] >= 0) == bool((feasible == 1).any())
    if best[0] >= 0:
        assert feasible[best] == 1 and ok[best] == ok.max() and at["best_command"].startswith("bench ")
    assert file["provenance"].attrs["commit"] and file["config"].attrs["formulation"] == "quadric"
    assert file["domain"].attrs["length"] > 0 and file["domain/frame_rotation"].shape == (3, 3)
