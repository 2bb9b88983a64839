"""Reads records of nestings (schema: results/README.md) into plain dicts, read-only."""

import pathlib

import h5py

import records

SCHEMA, NEWEST = "kreisel nesting", 1
# Columns of `trace` and of `accuracy/errors`.
ITERATION, EVALUATIONS, BEST, MEAN, FEASIBLE, SECONDS = range(6)
RESOLUTION, OPTIMISTIC, PESSIMISTIC, MISSED, MEDIAN, PERCENTILE_95, LARGEST = range(7)


def read(path):
    """A nesting as a dict: root attributes and `trace` at the top, each group a dict of its attributes and datasets."""
    path = pathlib.Path(path)
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != SCHEMA or not 1 <= file.attrs.get("schema_version", 0) <= NEWEST:
                raise records.BadRecord(f"{path}: not a nesting, expected schema = {SCHEMA}, version 1 to {NEWEST}")
            found = {"path": path, **records.attributes(file)}
            for name, node in file.items():
                if isinstance(node, h5py.Dataset):
                    found[name] = node[...]
                else:
                    found[name] = {**records.attributes(node), **records.tables(node, ())}
            return found
    except OSError:
        reason = "not readable as HDF5" if path.exists() else "no such file"
        raise records.BadRecord(f"{path}: {reason}, expected what bench nest --record wrote") from None


def read_folder(folder):
    """Every nesting in a folder and the folders in it, by name."""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise records.BadRecord(f"{folder}: no such folder, expected one with records")
    found = [read(path) for path in sorted(folder.rglob("*.h5")) if records.is_nesting(path)]
    if not found:
        raise records.BadRecord(f"{folder}: no nestings (*.h5) in it")
    return found


def searched(found):
    """A row (records.columns) for each search over placements that found one."""
    runs = [run for run in records.with_results(found) if "trace" in run]
    if not runs:
        raise records.BadRecord("no search over placements among the records")
    return records.columns(runs, "shapes", "certified_scale")


def settings(rows):
    """What of the configuration of each differs among them, seeds and shapes aside: "swarms = 4"."""
    return [records.setting_text(fields) for fields in records.differences(rows, ("outer", "inner", "seed"))]


def by_shapes(rows):
    groups = {}
    for row in rows:
        groups.setdefault(row["shapes"], []).append(row)
    return groups
