#!/usr/bin/python3
"""Does what docs/extending says, builds it, runs its tests, and takes it back: extending.py BUILD

Adds files to the source tree and edits registries there, for objects that exist already need not be built again.
Refuses where a file is there already. Everything is as it was in the end, but the build.
"""

import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"```\w+\n(.*?)```", re.S)


def additions(text):
    """{path: code} of headings that name a file."""
    return {path: code for path, code in re.findall(r"\*\*`([^`]+)`\*\*\n+```\w+\n(.*?)```", text, re.S)}


def edits(text):
    """(path, what is said of it, its blocks) of sentences that begin with "In `path`"."""
    for match in re.finditer(r"^In `([^`]+)`,(.*?)\n\n((?:```\w+\n.*?```\n)+)", text, re.S | re.M):
        yield match[1], match[2], BLOCK.findall(match[3])


def edited(source, said, blocks, where):
    for block in blocks:
        function = re.search(r"at the end of\s+`(\w+)\(\)`", said)
        if block.startswith("#include"):
            at = source.index("#include \"" + block.split('"')[1].split("/")[0] + "/", source.index("\n\n"))
            source = source[:at] + block + source[at:]
        elif function:
            begin = source.index(f" {function[1]}() {{")
            end = source.index("\n  };\n", begin)
            last = source[:end].rstrip()
            source = last + ("" if last.endswith(",") else ",") + "\n" + block.rstrip().rstrip(",") + source[end:]
        else:
            raise AssertionError(f"{where}: where do these lines go?\n{block}")
    return source


def run_programs(build, results):
    """What was added, in every program, with nothing else changed: a table, records, a map, a part."""
    def run(*command, ends=0):
        done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE)
        print(done.stdout)
        assert done.returncode == ends, f"{command}: exit code {done.returncode}"
        return done.stdout

    shutil.rmtree(results, ignore_errors=True)
    table = run(build / "bench", "run", ROOT / "experiments" / "layers.toml", "--results", results)
    rows = [line for line in table.splitlines() if " layer " in line]
    assert sum(" compass " in row for row in rows) == 2 and sum(" ipopt " in row for row in rows) == 2, table
    assert "compass.penalty" in run(build / "bench", "fields", "--markdown")
    record, part = results / "lowest.h5", results / "lowest.3mf"
    run(build / "bench", "--model", "ellipsoid", "--problem", "lowest", "--mass", "70%", "--formulation", "layer",
        "--solver", "compass", "--set", "compass.finest=1e-6", "--resolution", "32", "--record", record,
        ends=4)  # layers cannot move the centre of mass sideways: the search ends, and its record says so
    shown = run(build / "bench", "show", record)
    assert all(name in shown for name in ("lowest", "layer", "compass")), shown
    run(build / "bench", "map", "kitten", "--problem", "lowest", "--axes", "12", "--resolution", "32",
        "--record", results / "map.h5")
    assert "lowest" in run(build / "bench", "show", results / "map.h5")
    run(build / "design", "lowest", "kitten", "-o", part, "--mass", "70%", "--resolution", "64")
    assert "closed" in run(build / "bench", "inspect", part)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    kept, suites = {}, []
    try:
        for document in sorted((ROOT / "docs" / "extending").glob("*.md")):
            text = document.read_text()
            for name, code in additions(text).items():
                path = ROOT / name
                assert not path.exists(), f"{path} is there already"
                kept[path] = None
                path.write_text(code)
                suites += re.findall(r"^(?:TEST|TEST_F|TEST_P)\((\w+),", code, re.M)
                suites += re.findall(r"INSTANTIATE_TEST_SUITE_P\(\w*, (\w+),", code)
            for name, said, blocks in edits(text):
                path = ROOT / name
                kept.setdefault(path, path.read_text())
                path.write_text(edited(path.read_text(), said, blocks, document.name))
        assert suites, "no tests in docs/extending"
        added = ";".join(str(path) for path, text in kept.items() if text is None)
        subprocess.run(["cmake", build, f"-DKREISEL_ALONE={added}"], check=True, stdout=subprocess.DEVNULL)
        subprocess.run(["cmake", "--build", build, "--target", "kreisel_tests", "bench", "design"], check=True,
                       stdout=subprocess.DEVNULL)
        wanted = ":".join(f"*{suite}*" for suite in sorted(set(suites)))
        subprocess.run([build / "tests" / "kreisel_tests", f"--gtest_filter={wanted}"], check=True)
        run_programs(build, build / "extending")
    finally:
        for path, text in kept.items():
            path.unlink() if text is None else path.write_text(text)
        subprocess.run(["cmake", build, "-DKREISEL_ALONE="], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
