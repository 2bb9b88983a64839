#!/usr/bin/python3
"""Does a simulation hold what results/README.md says? Usage: simulation_h5py_test.py FILE.h5; exit status 1 when not."""

import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "r") as file:
    at = file.attrs
    assert at["schema"] == "kreisel simulation" and at["schema_version"] == 1
    assert at["contact"] in ("gliding", "held", "free") and at["length"] > 0 and at["rpm"] > 0
    for name in ("solid", "part"):
        body = file[name]
        assert body["moments"].shape == (10,) and body.attrs["text"]
        assert set(body["values"].attrs) >= {"omega_min_rpm", "largest_over_lateral"}
        spin = body["spin"]
        for contact in ("gliding", "held", "free"):
            ranges = spin["stable_rpm_" + contact][...]
            assert ranges.shape == (len(ranges), 2) and (ranges[:, 0] < ranges[:, 1]).all()
        motion = spin["motion"][...]
        assert motion.shape[1] == 2 and motion[0, 0] == 0 and (np.diff(motion[:, 0]) > 0).all()
        assert np.isclose(motion[0, 1], at["tilt_degrees"])
        assert motion[:, 1].max() <= spin.attrs["largest_tilt_degrees"] * (1 + 1e-12)
        fell = spin.attrs["fell_at"]
        assert np.isclose(motion[-1, 0], at["seconds"] if np.isnan(fell) else fell)
        assert 0 <= spin.attrs["energy_drift"] < 1e-6 and 0 <= spin.attrs["momentum_drift"] < 1e-9
        assert spin["motion"].attrs["units"] == "s, degrees"
        x, y, z, w = spin["attitude"][...].T
        assert len(x) == len(motion) and np.allclose(x**2 + y**2 + z**2 + w**2, 1)
        tilt = np.degrees(np.arccos(np.clip(1 - 2 * (x**2 + y**2), -1, 1)))
        assert np.allclose(tilt, motion[:, 1], atol=1e-3), np.abs(tilt - motion[:, 1]).max()
    assert file["provenance"].attrs["commit"] and file["config"].attrs["problem"] == at["problem"]
