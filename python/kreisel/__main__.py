"""`python -m kreisel live [MODEL]`: the page of `design live`, by the program that was built or installed beside this package."""

import os
import pathlib
import shutil
import sys


def program():
    """Where `design` is: in the build folder, below the same prefix, or in the path. None: nowhere."""
    folder = pathlib.Path(__file__).resolve().parent
    beside = [folder.parents[1] / "design", *(above / "bin" / "design" for above in folder.parents)]
    return next((str(path) for path in beside if os.access(path, os.X_OK) and path.is_file()), None) or shutil.which("design")


def main(arguments):
    if arguments[:1] != ["live"]:
        print("usage: python -m kreisel live [MODEL] [--port N] [--no-browser] ...", file=sys.stderr)
        return 0 if arguments[:1] in (["-h"], ["--help"]) else 2
    found = program()
    if not found:
        print("kreisel: no `design` beside this package or in the path; expected Kreisel's programs, installed", file=sys.stderr)
        return 2
    os.execv(found, [found, *arguments])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
