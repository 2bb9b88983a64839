#!/usr/bin/python3
"""Makes every part of a list with `design` and asks a slicer about each; a table as CSV."""

import argparse
import csv
import json
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("list", help="TOML: [[part]] with name and design (the arguments of `design`)")
    parser.add_argument("--design", default="design", help="the program (default %(default)s)")
    parser.add_argument("-o", "--output", default="parts", help="folder of the parts (default %(default)s)")
    parser.add_argument("--only", help="a regular expression for names")
    parser.add_argument("--slice", action="store_true", help="also slice to G-code, which takes seconds each")
    return parser.parse_args()


def made(program, part, stl):
    """What `design` reports, its exit code and the seconds it took."""
    report = stl.with_suffix(".json")
    begin = time.monotonic()
    done = subprocess.run([program, *part["design"].split(), "-o", stl, "--json", report, "--force"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    seconds = time.monotonic() - begin
    if done.returncode not in (0, 3, 4, 5):
        print(done.stdout, file=sys.stderr)
        return None, done.returncode, seconds
    return json.loads(report.read_text()), done.returncode, seconds


def slicer_says(stl):
    """PrusaSlicer's fields of --info; its exit code says nothing, and its volume is summed in single precision."""
    said = subprocess.run(["prusa-slicer", "--info", stl], capture_output=True, text=True, check=False).stdout
    return dict(re.findall(r"^(\w+) = +(\S+)", said, re.M))


def slices(stl):
    gcode = stl.with_suffix(".gcode")
    subprocess.run(["prusa-slicer", "--export-gcode", "--support-material", "-o", gcode, stl], capture_output=True,
                   check=False)
    good = gcode.exists() and gcode.stat().st_size > 100_000
    gcode.unlink(missing_ok=True)
    return good


def row_of_doll(report, options):
    """Of shapes in each other: what is worst of all their parts."""
    row = {"ok": report["ok"], "mass_g": f"{sum(part['mass_g'] for part in report['parts']):.4f}",
           "off_mm": min(layer["gap_mm"] for layer in report["layers"]),
           "wall_mm": min(layer["wall_mm"] for layer in report["layers"]), "wall_asked_mm": report["wall_asked_mm"],
           "triangles": sum(part["triangles"] for part in report["parts"]), "text": report["text"]}
    if shutil.which("prusa-slicer"):
        said = [slicer_says(part["file"]) for part in report["parts"]]
        row["manifold"] = "yes" if all(one.get("manifold") == "yes" for one in said) else "no"
        row["volume_differs"] = max(abs(float(one.get("volume", "nan")) / part["volume_mm3"] - 1)
                                    for one, part in zip(said, report["parts"]))
        if options.slice:
            row["slices"] = all(slices(pathlib.Path(part["file"])) for part in report["parts"])
    return row


def row_of(part, options):
    stl = pathlib.Path(options.output) / (part["name"] + ".stl")
    report, code, seconds = made(options.design, part, stl)
    row = {"name": part["name"], "design": part["design"], "exit": code, "seconds": f"{seconds:.1f}"}
    if report and report["problem"] == "nest":
        return row | (row_of_doll(report, options) if report["layers"] else {})
    if not report or not report["after"]:
        return row
    after, residual = report["after"], report["constraint_residual"]
    row |= {"ok": after["ok"], "mass_g": f"{after['mass_g']:.4f}", "off_mm": residual["centre_of_mass_mm"],
            "tilt_degrees": residual["axis_degrees"], "wall_mm": report["wall_mm"],
            "wall_asked_mm": report["wall_asked_mm"], "voids": len(report["voids"]), "cuts": len(report["cuts"]),
            "triangles": report["triangles"], "text": after["text"]}
    if shutil.which("prusa-slicer"):
        said = slicer_says(stl)
        row["manifold"] = said.get("manifold")
        row["volume_differs"] = abs(float(said.get("volume", "nan")) / after["volume_mm3"] - 1)
        if options.slice:
            row["slices"] = slices(stl)
    return row


def main():
    options = arguments()
    pathlib.Path(options.output).mkdir(parents=True, exist_ok=True)
    parts = tomllib.loads(pathlib.Path(options.list).read_text())["part"]
    rows = []
    for part in parts:
        if options.only and not re.search(options.only, part["name"]):
            continue
        row = row_of(part, options)
        rows.append(row)
        print({key: value for key, value in row.items() if key != "design"}, flush=True)
    columns = dict.fromkeys(key for row in rows for key in row)
    with open(pathlib.Path(options.output) / "parts.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    main()
