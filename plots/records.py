"""Reads records of runs (schema: results/README.md) into plain dicts, read-only."""

import pathlib
import sys

import h5py

SCHEMA = "kreisel run"
NEWEST = 1
LARGE = ("x", "history", "intervals")  # datasets that grow with the resolution or the solve


class BadRecord(Exception):
    """A file or folder that is not what was asked for; the text is one line."""


def _attributes(node):
    return {name: value.item() if hasattr(value, "item") else value for name, value in node.attrs.items()}


def _tables(group, but):
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
            record = {"path": path, **_attributes(file)}
            for name, group in file.items():
                record[name] = {**_attributes(group), **_tables(group, () if arrays else LARGE)}
            if "verified" in file:
                record["verified"]["values"] = _attributes(file["verified/values"])
            return record
    except OSError as error:
        reason = "no such file" if not path.exists() else str(error).split("(")[-1].rstrip(")")
        raise BadRecord(f"{path}: not readable as HDF5: {reason}") from None
    except KeyError as error:
        raise BadRecord(f"{path}: incomplete record: {error}") from None


def read_folder(folder, arrays=False):
    """Every record (*.h5) of a folder and the folders in it, by name."""
    folder = pathlib.Path(folder)
    if not folder.is_dir():
        raise BadRecord(f"{folder}: no such folder, expected one with records")
    found = [read(path, arrays) for path in sorted(folder.rglob("*.h5"))]
    if not found:
        raise BadRecord(f"{folder}: no records (*.h5) in it")
    return found


def provenance_line(records):
    """Where results come from, for captions: every commit and device among the records."""
    def all_of(field):
        return ", ".join(sorted({r["provenance"][field] or "unknown" for r in records}))

    return f"Commit {all_of('commit')}; device {all_of('device')}; host {all_of('host')}"


def save(figure, path):
    """Writes a PNG at 150 dpi; creates its folder."""
    path = pathlib.Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=150)
    except (OSError, ValueError) as error:
        raise BadRecord(f"{path}: cannot be written: {error}") from None


def main_with(run):
    """Runs a script's main; what the user can mend becomes one line and exit status 2."""
    try:
        run()
    except BadRecord as error:
        print(f"{pathlib.Path(sys.argv[0]).name}: {error}", file=sys.stderr)
        sys.exit(2)
    except KeyError as error:
        print(f"{pathlib.Path(sys.argv[0]).name}: a record lacks {error}", file=sys.stderr)
        sys.exit(2)
