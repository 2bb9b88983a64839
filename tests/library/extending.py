#!/usr/bin/python3
"""Does what docs/extending says, builds it, runs its tests, and takes it back: extending.py BUILD

Adds files to the source tree and edits registries there, for objects that exist already need not be built again.
Refuses where a file is there already. Everything is as it was in the end, but the build.
"""

import pathlib
import re
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
        subprocess.run(["cmake", "--build", build, "--target", "kreisel_tests", "bench"], check=True,
                       stdout=subprocess.DEVNULL)
        wanted = ":".join(f"*{suite}*" for suite in sorted(set(suites)))
        subprocess.run([build / "tests" / "kreisel_tests", f"--gtest_filter={wanted}"], check=True)
        subprocess.run([build / "bench", "run", ROOT / "experiments" / "layers.toml", "--results", build / "extending"],
                       check=True)
    finally:
        for path, text in kept.items():
            path.unlink() if text is None else path.write_text(text)


if __name__ == "__main__":
    main()
