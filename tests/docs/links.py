#!/usr/bin/python3
"""Do the links between Markdown pages lead somewhere? links.py [ROOT]; exit status 1 where one does not.

Checked are links and pictures of README.md, CONTRIBUTING.md, results/README.md and docs/: the file, and behind # the heading.
"""

import pathlib
import re
import sys


def anchors(page):
    """What a page's headings are called in links."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    found = set()
    for heading in re.findall(r"^#+ (.*)$", text, flags=re.M):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        found.add(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
    return found


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    pages = [root / "README.md", root / "CONTRIBUTING.md", root / "results/README.md", *sorted(root.glob("docs/**/*.md"))]
    checked, wrong = 0, []
    for page in pages:
        text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text)):
            if re.match(r"[a-z]+:", target):
                continue
            checked += 1
            file, _, anchor = target.partition("#")
            to = (page.parent / file).resolve() if file else page
            if not to.exists():
                wrong.append(f"{page.relative_to(root)}: {target}: no such file")
            elif anchor and to.suffix == ".md" and anchor not in anchors(to):
                wrong.append(f"{page.relative_to(root)}: {target}: no such heading")
    print(*wrong, f"{checked} links checked, {len(wrong)} lead nowhere", sep="\n")
    assert checked > 100, "links were not found"
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
