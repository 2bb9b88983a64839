"""Reads records of runs (schema: results/README.md) into plain dicts, read-only. Needs h5py alone."""

import pathlib

import h5py

SCHEMA = "kreisel run"
NEWEST = 1
LARGE = ("x", "history", "intervals")  # datasets that grow with the resolution or the solve


class BadRecord(Exception):
    """A file or folder that is not what was asked for; the text is one line."""


def attributes(node):
    return {name: value.item() if hasattr(value, "item") else value for name, value in node.attrs.items()}


def tables(group, but):
    return {name: node[...] for name, node in group.items()
            if isinstance(node, h5py.Dataset) and name not in but}


def read(path, arrays=True):
    """One record: root attributes at the top, each group a dict of its attributes and datasets.

    arrays=False leaves out the datasets named in LARGE. A failed run has the key
    "error" and no more than "config" and "provenance" beside it.
    """
    path = pathlib.Path(path)
    try:
        with h5py.File(path, "r") as file:
            if file.attrs.get("schema") != SCHEMA:
                raise BadRecord(f"{path}: not a record of a run, expected the attribute schema = {SCHEMA}")
            version = file.attrs.get("schema_version", 0)
            if not 1 <= version <= NEWEST:
                raise BadRecord(f"{path}: schema version {version}, expected 1 to {NEWEST}")
            record = {"path": path, **attributes(file)}
            for name, group in file.items():
                record[name] = {**attributes(group), **tables(group, () if arrays else LARGE)}
            if "verified" in file:
                record["verified"]["values"] = attributes(file["verified/values"])
                materials = file.get("verified/materials") or {}  # early records have none
                record["verified"]["materials"] = {name: attributes(group) for name, group in materials.items()}
            return record
    except OSError as error:
        reason = "no such file" if not path.exists() else str(error).split("(")[-1].rstrip(")")
        raise BadRecord(f"{path}: not readable as HDF5: {reason}") from None
    except KeyError as error:
        raise BadRecord(f"{path}: incomplete record: {error}") from None


def schema_of(path):
    """What the file says it is; None where it says nothing or is no HDF5."""
    try:
        with h5py.File(path, "r") as file:
            return file.attrs.get("schema")
    except OSError:
        return None


def is_map(path):
    """Whether it is the record of a map of orientations (map.py), not of a run."""
    return schema_of(path) == "kreisel map"


def is_nesting(path):
    """Whether it is the record of a nesting (nestings.py), not of a run."""
    return schema_of(path) == "kreisel nesting"


def read_folder(folder, arrays=False):
    """Every record (*.h5) of a run in a folder and the folders in it, by name."""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise BadRecord(f"{folder}: no such folder, expected one with records")
    found = [read(path, arrays) for path in sorted(folder.rglob("*.h5"))
             if not is_map(path) and not is_nesting(path)]
    if not found:
        raise BadRecord(f"{folder}: no records (*.h5) in it")
    return found


def _flat(node, prefix, most):
    """Attributes and datasets of up to `most` values below a group: {"group.name": value}."""
    row = {prefix + name: value for name, value in attributes(node).items()}
    for name, child in node.items():
        if isinstance(child, h5py.Group):
            row.update(_flat(child, f"{prefix}{name}.", most))
        elif child.size <= most:
            value = child[...]
            row[prefix + name] = value.item() if value.size == 1 else value
    return row


def records(folder, most=64):
    """A row a record (*.h5) of a folder and the folders in it, whatever its kind, for a table:

        pandas.DataFrame(kreisel.records("results/runs/rayrep_table2"))

    Columns are named as in the file, "group.name"; arrays of more than `most` values are left out. Raises
    BadRecord where a file cannot be read, or there is none.
    """
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise BadRecord(f"{folder}: no such folder, expected one with records")
    rows = []
    for path in sorted(folder.rglob("*.h5")):
        try:
            with h5py.File(path, "r") as file:
                if not str(file.attrs.get("schema", "")).startswith("kreisel "):
                    raise BadRecord(f"{path}: no record, expected the attribute schema = kreisel ...")
                rows.append({"path": str(path), **_flat(file, "", most)})
        except OSError as error:
            raise BadRecord(f"{path}: not readable as HDF5: {str(error).split('(')[-1].rstrip(')')}") from None
    if not rows:
        raise BadRecord(f"{folder}: no records (*.h5) in it")
    return rows
