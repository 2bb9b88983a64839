#!/usr/bin/python3
"""Prints parts of a list three ways, as far as G-code goes, and says which of the prints do what was asked; a table as CSV
and Markdown.

full: the part with its voids, filled, as our profile has it. careless: the same with 15 % gyroid, which is how people
print. infill: `--infill 15% --balance print`; where no interior with infill does what was asked, voids: `--balance print`
of the first way. What was made is left out the next time.
"""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import tomllib

SPARSE = {"fill_density": "15%", "fill_pattern": "gyroid"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("list", help="TOML: [[part]] with name and design (the arguments of `design`)")
    parser.add_argument("--design", default="design", help="the program (default %(default)s)")
    parser.add_argument("-o", "--output", default="printed", help="folder of what is made (default %(default)s)")
    parser.add_argument("--only", help="a regular expression for names")
    parser.add_argument("--most", type=int, default=30, help="parts (default %(default)s)")
    return parser.parse_args()


def hours(gcode):
    """What the slicer estimates."""
    said = re.search(r"estimated printing time \(normal mode\) = (.*)", gcode.read_text(errors="replace"))
    units = {"d": 24, "h": 1, "m": 1 / 60, "s": 1 / 3600}
    return sum(float(n) * units[unit] for n, unit in re.findall(r"(\d+)([dhms])", said[1])) if said else 0


def made(options, part, way, more):
    """The report of one way to print a part, or the line that says why there is none."""
    stem = pathlib.Path(options.output) / f"{part['name']}-{way}"
    report, gcode = stem.with_suffix(".json"), stem.with_suffix(".gcode")
    if not report.exists():
        done = subprocess.run([options.design, *part["design"].split(), "-o", stem.with_suffix(".3mf"), "--json", report,
                               "--gcode", gcode, "--force", *more],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if not report.exists():
            return {"text": done.stdout.strip().splitlines()[-1] if done.stdout.strip() else f"exit {done.returncode}"}
    said = json.loads(report.read_text())
    if "print" not in said:
        return {"text": said.get("infeasibility", "")}
    gcodes = [gcode] if gcode.exists() else sorted(stem.parent.glob(f"{stem.name}-*.gcode"))  # of pieces
    misses = said["print"]["constraint_residual"]
    return {"ok": said["print"]["ok"], "off_mm": misses["centre_of_mass_mm"], "tilt_degrees": misses["axis_degrees"],
            "mass_off_g": misses["mass_g"], "mass_g": f"{said['print']['mass_g']:.3f}",
            "hours": f"{sum(map(hours, gcodes)):.2f}" if gcodes else "", "slicings": len(said["print"]["rounds"]),
            "support_in_voids_mm3": said["print"]["support_in_voids_mm3"], "seconds": f"{said['seconds']:.1f}",
            "text": said["print"]["text"]}


def write_sparse(profile, part, options):
    """The profile of the full print, but for its infill. Returns whether there was one."""
    report = pathlib.Path(options.output) / f"{part['name']}-full.json"
    said = json.loads(report.read_text()) if report.exists() else {}
    if "print" not in said:
        return False
    profile.write_text("".join(f"{name} = {value}\n" for name, value in (said["print"]["settings"] | SPARSE).items()))
    return True


def misses(row):
    """By how much a print misses what was asked, and whether it does it all the same."""
    if "ok" not in row:
        return "no interior does it"
    told = [f"{row[name]:.2g} {unit}" for name, unit in (("off_mm", "mm"), ("tilt_degrees", "degrees"), ("mass_off_g", "g"))
            if row.get(name) is not None and not (name == "off_mm" and row[name] == 0)]
    return ", ".join(told + ["yes" if row["ok"] else "no"])


def markdown(rows):
    """A row a part: the three ways beside each other."""
    lines = ["| part | filled | 15 % infill | balanced, 15 % in place of voids | slicings | grams | hours |", "|---|---|---|---|---|---|---|"]
    for name in dict.fromkeys(row["name"] for row in rows):
        ways = {row["way"]: row for row in rows if row["name"] == name}
        balanced = "infill" if "ok" in ways.get("infill", {}) or "voids" not in ways else "voids"
        last = ways.get(balanced, {})
        cells = [misses(ways.get(way, {})) for way in ("full", "careless", balanced)]
        cells[2] += " (voids)" if balanced == "voids" else ""
        lines.append(f"| {name} | " + " | ".join(cells + [str(last.get(key, "")) for key in ("slicings", "mass_g", "hours")]) + " |")
    return "\n".join(lines) + "\n"


def main():
    options = arguments()
    folder = pathlib.Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    sparse = folder / "sparse.ini"
    ways = {"full": ["--slicer", "prusa-slicer"], "careless": ["--slicer", "prusa-slicer", "--profile", sparse],
            "infill": ["--infill", "15%", "--balance", "print"], "voids": ["--slicer", "prusa-slicer", "--balance", "print"]}
    parts = [part for part in tomllib.loads(pathlib.Path(options.list).read_text())["part"]
             if not part["design"].startswith("nest") and re.search(options.only or "", part["name"])]
    rows = []
    for part in parts[:options.most]:
        for way, more in ways.items():
            if way == "careless" and not sparse.exists() and not write_sparse(sparse, part, options):
                continue  # there is no print of it
            if way == "voids" and "ok" in rows[-1]:
                continue
            rows.append({"name": part["name"], "way": way} | made(options, part, way, more))
            print(rows[-1], flush=True)
    (folder / "printed.md").write_text(markdown(rows), encoding="utf-8")
    with open(folder / "printed.csv", "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, dict.fromkeys(key for row in rows for key in row))
        table.writeheader()
        table.writerows(rows)


if __name__ == "__main__":
    main()
