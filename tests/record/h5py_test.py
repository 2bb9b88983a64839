#!/usr/bin/python3
"""Does a record hold what results/README.md says? Usage: h5py_test.py RECORD.h5; exit status 1 when not."""

import sys

import h5py
import numpy as np

TEXT, WHOLE, REAL, FLAG = str, np.int64, np.float64, np.uint8

MOMENTS = ["s1", "sx", "sy", "sz", "sxy", "syz", "sxz", "sxx", "syy", "szz"]
SECONDS = ["setup", "kernels", "solve", "total"]
XYZ = ["x", "y", "z"]

ATTRIBUTES = {
    "/": {
        "schema": TEXT, "schema_version": WHOLE, "moments_order": TEXT, "model": TEXT, "problem": TEXT,
        "formulation": TEXT, "solver": TEXT, "termination": TEXT, "objective": REAL,
        "constraint_violation": REAL, "iterations": WHOLE, "variables": WHOLE,
        "whole_seconds": REAL, "peak_bytes": REAL, "summary": TEXT,
    },
    "/provenance": {
        "version": TEXT, "commit": TEXT, "compiler": TEXT, "build_type": TEXT, "host": TEXT,
        "processor": TEXT, "system": TEXT, "threads": WHOLE, "device": TEXT, "platform": TEXT,
        "driver": TEXT, "device_version": TEXT, "device_fp64": FLAG, "single_precision": FLAG,
        "ipopt_version": TEXT, "linear_solver": TEXT, "blas": TEXT, "started": TEXT, "load": REAL,
    },
    "/body": {
        "name": TEXT, "repairs": TEXT, "density": REAL, "interior_density": REAL, "void_density": REAL, "density_units": TEXT, "solid_mass": REAL, "solid_mass_units": TEXT,
        "length": REAL, "length_units": TEXT, "mass_unit": REAL, "mass_unit_units": TEXT,
        "solid_objective": REAL,
    },
    "/domain": {
        "kind": TEXT, "wall": REAL, "wall_units": TEXT, "spacing": REAL, "spacing_units": TEXT,
        "rays": WHOLE, "inside_voxels": WHOLE, "interior_voxels": WHOLE,
    },
    "/solve": {
        "message": TEXT, "scope": TEXT, "infeasibility": TEXT, "remedies": TEXT, "steps": WHOLE, "dual_infeasibility": REAL, "complementarity": REAL, "kernel_seconds": REAL,
        "solve_seconds": REAL, "evaluations_objective": WHOLE, "evaluations_gradient": WHOLE,
        "evaluations_constraints": WHOLE, "evaluations_jacobian": WHOLE, "evaluations_hessian": WHOLE,
        "repeat": WHOLE, "budget": REAL, "budget_units": TEXT, "x_unit_length": REAL,
    },
    "/rounding": {
        "objective": REAL, "violation": REAL, "solid_voxels": WHOLE, "void_voxels": WHOLE,
        "mended_voxels": WHOLE, "moved_voxels": WHOLE,
    },
    "/verified": {
        "ok": FLAG, "text": TEXT, "file": TEXT, "rounding_mismatch": REAL, "triangles": WHOLE,
        "void_triangles": WHOLE, "voids": WHOLE, "islands": WHOLE, "cuts": WHOLE,
    },
}

# Of each material in /verified/materials.
MATERIAL = {"density": REAL, "mass": REAL, "file": TEXT, "triangles": WHOLE}

# Of the 2014 form of a spinning problem alone.
ANGLE_FORM = {"/solve": {"phi": REAL, "phi_units": TEXT}}

# Of a solve in the moments that converged.
MINIMUM = {"/solve": {"strict_local_minimum": TEXT, "smallest_eigenvalue": REAL, "tangent_dimension": WHOLE,
                      "why_undecided": TEXT}}

# Of a certified run alone.
CERTIFIED = {
    "/": {"bound": REAL, "gap": REAL},
    "/certificate": {
        "kind": TEXT, "bound": REAL, "best": REAL, "reached": FLAG, "message": TEXT, "seconds": REAL,
        "searches": WHOLE, "separation": REAL, "contrast": REAL, "lambda": REAL, "height": REAL,
        "moment": REAL, "gamma_i": REAL, "sz_most": REAL,
    },
}

# name: (type, shape with None for any length, names of the columns)
DATASETS = {
    "/body/axis": ("f8", (3,), XYZ),
    "/body/contact": ("f8", (3,), XYZ),
    "/body/frame_origin": ("f8", (3,), XYZ),
    "/body/frame_rotation": ("f8", (3, 3), XYZ),
    "/body/solid": ("f8", (10,), MOMENTS),
    "/body/fixed": ("f8", (10,), MOMENTS),
    "/body/interior": ("f8", (10,), MOMENTS),
    "/domain/grid": ("i4", (3,), XYZ),
    "/domain/grid_origin": ("f8", (3,), XYZ),
    "/domain/intervals": ("i4", (None, 4), ["ix", "iy", "k0", "k1"]),
    "/solve/x": ("f8", (None,), None),
    "/solve/moments": ("f8", (10,), MOMENTS),
    "/solve/moments_model": ("f8", (10,), MOMENTS),
    "/solve/history": ("f8", (None, 7), ["iteration", "objective", "violation", "dual_infeasibility",
                                         "barrier", "regularization", "line_search_trials"]),
    "/solve/samples": ("f8", (None, 4), SECONDS),
    "/solve/median": ("f8", (1, 4), SECONDS),
    "/rounding/moments": ("f8", (10,), MOMENTS),
    "/verified/moments": ("f8", (10,), MOMENTS),
    "/voids/pieces": ("f8", (None,), None),
    "/voids/islands": ("f8", (None,), None),
    "/voids/cuts": ("f8", (None, 5), ["nx", "ny", "nz", "offset", "opens"]),
}

# Of an octree alone.
OCTREE_DATASETS = {
    "/solve/cells": ("i4", (None, 4), ["ix", "iy", "iz", "edge"]),
    "/solve/refinements": ("f8", (None, 11), ["variables", "fractional", "to_split", "finest", "along_voids", "weight",
                                              "objective", "regulariser", "violation", "iterations", "seconds"]),
}

CERTIFIED_DATASETS = {
    "/certificate/q": ("f8", (1, 10), MOMENTS),
    "/certificate/rows": ("f8", (None, 10), MOMENTS),
    "/certificate/bounds": ("f8", (None,), None),
    "/certificate/equality": ("i4", (None,), None),
    "/certificate/multipliers": ("f8", (None,), None),
    "/certificate/objective": ("f8", (1, 10), MOMENTS),
    "/certificate/numerators": ("f8", (None, 10), MOMENTS),
    "/certificate/weights": ("f8", (None,), None),
    "/certificate/denominator": ("f8", (1, 10), MOMENTS),
    "/certificate/boxes": ("f8", (None, 14), ["c_low", "c_high", "empty", "value", "t_low", "t_high", "u1", "u2",
                                              "u3", "mu_x", "mu_y", "mu_xz", "mu_yz", "nu"]),
    "/certificate/box_quadrics": ("f8", (None, 10), MOMENTS),
}


def check(file):
    """Every way in which an open file departs from the schema, one line each."""
    wrong = []

    def expect(fine, *words):
        if not fine:
            wrong.append(" ".join(map(str, words)))

    attributes, datasets = ATTRIBUTES, dict(DATASETS)
    if file["domain"].attrs.get("kind") == "exact":
        datasets["/domain/intervals"] = ("f8", (None, 4), ["ix", "iy", "z0", "z1"])
    if "refinements" in file["solve"]:
        datasets |= OCTREE_DATASETS
    if "phi" in file["solve"].attrs:
        attributes = {g: ATTRIBUTES[g] | ANGLE_FORM.get(g, {}) for g in ATTRIBUTES}
    if "strict_local_minimum" in file["solve"].attrs:
        expect(file.attrs.get("solver") == "moment", "a solver that does not judge its minimum")
        attributes = {g: attributes[g] | MINIMUM.get(g, {}) for g in attributes}
    if "certificate" in file:
        attributes = {g: attributes.get(g, {}) | CERTIFIED.get(g, {}) for g in attributes | CERTIFIED}
        datasets |= CERTIFIED_DATASETS
    materials = file["verified/materials"]
    expect(len(materials) > 0, "no materials")
    attributes = attributes | {f"/verified/materials/{name}": MATERIAL for name in materials}
    for group, wanted in attributes.items():
        for name, kind in wanted.items():
            value = file[group].attrs.get(name)
            expect(isinstance(value, kind), group, name, "is", repr(value), "expected", kind.__name__)
        # Options of the solver and the formulation come as they are; every other attribute is of the schema.
        present = {name for name in file[group].attrs if not name.startswith(("setting_", "formulation_"))}
        expect(present == set(wanted), group, "has other attributes:",
               *present ^ set(wanted))
    for name, (kind, shape, columns) in datasets.items():
        data = file[name]
        fits = len(data.shape) == len(shape) and all(w in (None, n) for n, w in zip(data.shape, shape))
        expect(data.dtype == kind and fits, name, "is", data.dtype, data.shape, "expected", kind, shape)
        expect(isinstance(data.attrs.get("units"), str), name, "has no units")
        expect(columns is None or list(data.attrs.get("columns", [])) == columns, name, "has other columns")
    found = []
    file.visititems(lambda name, node: found.append("/" + name) if isinstance(node, h5py.Dataset) else None)
    expect(set(found) == set(datasets), "other datasets:", *set(found) ^ set(datasets))
    expect(all(isinstance(v, str) for v in file["config"].attrs.values()), "/config holds more than text")
    expect(all(isinstance(v, REAL) for v in file["verified/values"].attrs.values()),
           "/verified/values holds more than numbers")
    expect(file.attrs.get("schema") == "kreisel run", "schema is", file.attrs.get("schema"))
    expect(file.attrs.get("schema_version") == 1, "schema_version is", file.attrs.get("schema_version"))
    expect(len(file["domain/intervals"]) == file["domain"].attrs["rays"], "intervals and rays differ")
    expect(len(file["solve/x"]) == file.attrs["variables"], "x and variables differ in number")
    return wrong


def main():
    if len(sys.argv) != 2:
        print("usage: h5py_test.py RECORD.h5", file=sys.stderr)
        return 2
    with h5py.File(sys.argv[1], "r") as file:
        wrong = check(file)
    for line in wrong:
        print(f"{sys.argv[1]}: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
