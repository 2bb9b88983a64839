"""What the figures share: records of runs by body and setting, published numbers, the command line."""

import argparse
import collections
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "python"))  # the reader of records is the Python library's

from kreisel._records import (BadRecord, attributes, is_map, is_nesting, read, read_folder, schema_of,
                              tables)  # noqa: E402, F401


def with_results(found):
    """Those that did not end in an error."""
    return [r for r in found if "error" not in r]


def bench():
    """The program: what $KREISEL_BENCH says (`bench report` does), else what is built or installed beside this
    folder, else of the path."""
    places = [ROOT / "build" / build / "bench" for build in ("release", "dev")] + [ROOT.parent.parent / "bin" / "bench"]
    for program in (os.environ.get("KREISEL_BENCH"), *places, shutil.which("bench")):
        if program and os.access(program, os.X_OK):
            return str(program)
    raise BadRecord("no program `bench` to ask for columns, expected $KREISEL_BENCH, a build, or one in the path")


BODY = ("model", "grid", "problem", "formulation")


def columns(found, *names, published=None):
    """A row a record of `found`: what `bench columns` or the JSON of a record call by these names; with its path,
    configuration, provenance, and the record, for arrays."""
    command = [bench(), "show", *(str(run["path"]) for run in found), "--columns", ",".join(names), "--json", "-"]
    if published:
        command += ["--published", str(published)]
    asked = subprocess.run(command, capture_output=True, text=True, check=False)
    if asked.returncode:
        raise BadRecord(asked.stderr.strip() or f"{command[0]} ended with {asked.returncode}")
    rows = json.loads(asked.stdout)
    for row, run in zip(rows, found):
        row.update(config=run["config"], provenance=run["provenance"], record=run)
    return rows


def solves(found, *names, published=None):
    """columns() of solves, with those of BODY, "converged" and "seconds" as well."""
    rows = columns(found, *dict.fromkeys((*BODY, "converged", "seconds", *names)), published=published)
    for row in rows:
        row["grid"] = (row["grid"] or "").replace("x", "×")  # none of a run that failed early
    return rows


def solved(found, *names, published=None):
    """solves() of those that have a result."""
    runs = with_results(found)
    if not runs:
        raise BadRecord("no record with a result")
    return solves(runs, *names, published=published)


def by_body(rows, *keys):
    """{(model, grid, problem, *keys): rows of columns()}, in their order."""
    groups = collections.defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in ("model", "grid", "problem", *keys))].append(row)
    return groups


def differences(runs, but=(*BODY, "resolution")):
    """For each run the fields of its configuration, `but` these, that not all share: {name without group: text}.

    A field that a run leaves at its default is absent.
    """
    names = {name for run in runs for name in run["config"] if name not in but}
    varied = sorted(n for n in names if len({run["config"].get(n) for run in runs}) > 1)
    return [{n.split(".", 1)[-1]: run["config"][n] for n in varied if n in run["config"]} for run in runs]


def setting_text(fields):
    return ", ".join(f"{name} = {value}" for name, value in fields.items()) or "defaults"


def published_path(name):
    """In the source tree results/published, once installed beside this folder."""
    for folder in (ROOT / "published", ROOT / "results" / "published"):
        if (folder / f"{name}.json").is_file():
            return folder / f"{name}.json"
    raise BadRecord(f"published numbers '{name}': no such file under {ROOT}")


def read_published(path):
    """Source and rows of a paper's numbers."""
    try:
        data = json.loads(pathlib.Path(path).read_text())
        return str(data["source"]), [dict(row) for row in data["rows"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise BadRecord(f"{path}: not published numbers: {error}") from None


def draw_folder(figure, description, name, published=None, reader=None):
    """The command line of a script that draws a folder of records: FOLDER -o PNG [--published JSON].

    reader(folder) reads them, by default records of runs. figure(records, path of published numbers or None) returns a figure, or throws BadRecord.
    """
    parser = argparse.ArgumentParser(description=description.splitlines()[0])
    parser.add_argument("folder", help="folder of records (*.h5), searched with its sub-folders")
    parser.add_argument("-o", "--output", default=f"{name}.png", help="PNG to write (default %(default)s)")
    if published:
        parser.add_argument("--published", default=published, help="published numbers: name or JSON file "
                            "(default %(default)s)")
    args = parser.parse_args()
    path = None
    if published:
        path = args.published if args.published.endswith(".json") else published_path(args.published)
    read_all = reader or (lambda folder: read_folder(folder, arrays=True))
    found = sorted(read_all(args.folder), key=lambda r: r["provenance"]["started"])
    save(figure(found, path), args.output)
    print(args.output)


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
