#!/usr/bin/python3
"""One HTML page with the tables and figures of experiments: TABLES.json (written by `bench report`) -o PAGE.

The page needs nothing beside it: figures are embedded, tables are text and CSV to save.
"""

import argparse
import base64
import datetime
import html
import importlib
import io
import json
import os
import pathlib
import re
import sys
import urllib.parse

try:
    import map as orientation_map  # this folder's, beside Python's own
    import nestings
    import records
    import simulate
    from style import plt
except ImportError as error:
    print(f"report.py: Python cannot import {error.name}, expected h5py and matplotlib (setup.sh installs them)",
          file=sys.stderr)
    sys.exit(2)

STYLE = """
:root { --ink: #1f2328; --quiet: #6b7280; --line: #e5e7eb; --shade: #f6f7f9; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 78rem; padding: 1.5rem 1.5rem 4rem; color: var(--ink);
       font: 15px/1.5 system-ui, "Liberation Sans", sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .3rem; } h2 { font-size: 1.25rem; margin: 3rem 0 .4rem; }
h3 { font-size: .95rem; margin: 1.4rem 0 .3rem; white-space: pre-line; font-weight: 600; }
nav ul { padding-left: 1.2rem; } a { color: #0072b2; }
.quiet, .notes { color: var(--quiet); font-size: .82rem; } .notes { white-space: pre-line; }
.missing { color: #a04000; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .82rem; font-variant-numeric: tabular-nums; }
th, td { padding: .18rem .5rem; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { font-weight: 600; background: var(--shade); } th.group { text-align: center; }
th.left, td.left { text-align: left; } .first { border-left: 1px solid #cbd0d7; }
img { max-width: 100%; height: auto; display: block; margin: 1rem 0; }
@media print { h2 { break-before: page; } body { max-width: none; } }
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tables", help="JSON that `bench report` writes")
    parser.add_argument("-o", "--output", default="report.html", help="page to write (default %(default)s)")
    return parser.parse_args()


def text(words):
    return html.escape(str(words))


def spans(columns):
    """Neighbours of one group: (name, how many)."""
    found = []
    for column in columns:
        if found and found[-1][0] == column["group"]:
            found[-1][1] += 1
        else:
            found.append([column["group"], 1])
    return found


def table_html(columns, rows):
    groups = spans(columns)
    starts, at = set(), 0
    for _, count in groups:
        starts.add(at)
        at += count
    starts.discard(0)

    def classes(index):
        names = ["left"] * columns[index]["left"] + ["first"] * (index in starts)
        return f' class="{" ".join(names)}"' if names else ""

    lines = ["<div class=wide><table>"]
    if any(name for name, _ in groups):
        cells = "".join(f'<th class="group{" first" if i else ""}" colspan={count}>{text(name)}</th>'
                        for i, (name, count) in enumerate(groups))
        lines.append(f"<tr>{cells}</tr>")
    cells = "".join(f"<th{classes(i)}>{text(c['heading'])}</th>" for i, c in enumerate(columns))
    lines.append(f"<tr>{cells}</tr>")
    for row in rows:
        lines.append("<tr>" + "".join(f"<td{classes(i)}>{text(v)}</td>" for i, v in enumerate(row)) + "</tr>")
    lines.append("</table></div>")
    return "\n".join(lines)


def figure_html(name, found, published):
    """The figures of one script as images, or a line that says why there is none."""
    try:
        script = importlib.import_module(name)
        several = getattr(script, "figures", None)  # a script that draws a picture a record
        drawn = several(found, published) if several else [script.figure(found, published)]
    except (ModuleNotFoundError, AttributeError) as error:
        if isinstance(error, ModuleNotFoundError) and error.name != name:
            raise
        raise records.BadRecord(f"figure '{name}': expected a script of plots/ with figure(records, published)")
    except records.BadRecord as error:
        return f'<p class="missing">No figure "{text(name)}": {text(error)}.</p>'
    return "\n".join(image_html(name, figure) for figure in drawn)


def image_html(name, figure):
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=130)
    width = int(figure.get_figwidth() * 104)
    plt.close(figure)
    return (f'<img width={width} alt="{text(name)}" '
            f'src="data:image/png;base64,{base64.b64encode(data.getvalue()).decode()}">')


def about_html(about):
    """The paragraphs of the comment that opens the experiment's file."""
    about = re.sub(r"^\S+\.toml - ", "", about.strip())  # the name of the file stands elsewhere
    about = about[:1].upper() + about[1:]
    paragraphs = [" ".join(part.split()) for part in about.split("\n\n")]
    return "\n".join(f"<p>{text(part)}</p>" for part in paragraphs if part)


def read(path):
    """A record of any kind."""
    if records.is_map(path):
        return orientation_map.read(path)
    if records.schema_of(path) == "kreisel simulation":
        return {**simulate.read(path), "path": pathlib.Path(path)}
    return nestings.read(path) if records.is_nesting(path) else records.read(path)


def section_html(section):
    found = [read(path) for path in section["records"]] if section["figures"] else []  # a sweep has many
    for record, simulation in section.get("simulations", {}).items():  # for simulate.py
        next(run for run in found if str(run["path"]) == record)["simulation"] = simulation
    lines = [f'<h2 id="{text(section["name"])}">{text(section["title"])}</h2>', about_html(section["about"])]
    counts = f"{len(section['records'])} records of <code>bench run {text(section['name'])}</code>"
    made = section["made"]
    if made["dates"]:
        counts += f", {text(made['dates'][0])} to {text(made['dates'][1])}"
    counts += f". Commit {text(made['commit'])}; device {text(made['device'])}; host {text(made['host'])}."
    lines.append(f'<p class="quiet">{counts}</p>')
    if section["missing"]:
        lines.append(f'<p class="missing">{section["missing"]} of {section["runs"]} runs are not on record.</p>')
    lines += [figure_html(name, found, section["published"]) for name in section["figures"]]
    for block in section["blocks"]:
        lines.append(f"<h3>{text(block['heading'])}</h3>" if block["heading"] else "")
        lines.append(table_html(section["columns"], block["rows"]))
        lines.append(f'<p class="notes">{text(block["notes"].strip())}</p>' if block["notes"] else "")
    lines.append(f'<p class="notes">{text(section["legend"].strip())}</p>')
    data = "data:text/csv;charset=utf-8," + urllib.parse.quote(section["csv"])
    lines.append(f'<p class="quiet"><a download="{text(section["name"])}.csv" href="{data}">'
                 "The table as CSV, with all digits</a></p>")
    return "\n".join(line for line in lines if line)


def page_html(page):
    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
    entries = "".join(f'<li><a href="#{text(s["name"])}">{text(s["title"])}</a></li>' for s in page["sections"])
    sections = "\n".join(section_html(section) for section in page["sections"])
    return f"""<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Kreisel: experiments</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>{STYLE}</style></head><body>
<h1>Kreisel: experiments</h1>
<p class="quiet">Made {now} by kreisel {text(page["version"])}, commit {text(page["commit"])}. Every number comes from a
record; the commit and device that made it stand with each table.</p>
<nav><ul>{entries}</ul></nav>
{sections}
</body></html>
"""


def main():
    args = arguments()
    try:
        page = json.loads(pathlib.Path(args.tables).read_text())
    except (OSError, ValueError) as error:
        raise records.BadRecord(f"{args.tables}: not the tables of `bench report`: {error}") from None
    words = page_html(page)
    output = pathlib.Path(args.output)
    partial = output.with_name(f"{output.name}.{os.getpid()}.tmp")
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
        partial.write_text(words, encoding="utf-8")
        partial.replace(output)
    except OSError as error:
        raise records.BadRecord(f"{output}: cannot be written: {error.strerror}") from None
    finally:
        partial.unlink(missing_ok=True)
    print(output)


if __name__ == "__main__":
    records.main_with(main)
