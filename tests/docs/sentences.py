#!/usr/bin/python3
"""Words in the sentences of Markdown pages: sentences.py [--longest N] [--at-most MEDIAN] PAGE…

Prints for each page, and for all of them together, how many sentences there are, the median of their words and the 90th
percentile. Counted is what is read in one go: not headings, tables, code blocks, pictures, the targets of links, nor what
`bench report --markdown` writes. A piece of `code` is one word. With --longest the longest sentences are printed, too. With
--at-most the exit status is 1 where the median of all sentences is above it.
"""

import argparse
import doctest
import re
import statistics
import sys


def paragraphs(text):
    """The prose of a page, a paragraph or an entry of a list at a time.

    >>> list(paragraphs("# A\\n\\nOne\\ntwo.\\n- three\\n  four\\n\\n    code\\n\\n| a | b |\\n```\\nx\\n```\\nfive"))
    ['One two.', 'three four', 'five']
    """
    text = re.sub(r"<!-- table:.*?<!-- end -->", "\n\n", text, flags=re.S)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"^```.*?^```", "\n", text, flags=re.S | re.M)
    text = re.sub(r"^\s*!\[[^\]]*\]\([^)]*\)\s*$", "", text, flags=re.M)
    gathered, in_list = [], False
    for line in [*text.split("\n"), ""]:
        item = re.match(r"\s*(?:[-*]|\d+\.)\s+(.*)", line)
        plain = line.strip()
        apart = not plain or plain.startswith(("|", "#", "<")) or item
        code = line.startswith("    ") and not gathered and not (in_list and item)
        if apart or code:
            if gathered:
                yield " ".join(gathered)
            gathered = []
        if item and not line.startswith("     "):
            gathered, in_list = [item[1]], True
        elif plain and not apart and not code:
            gathered.append(plain)
            in_list = in_list and line.startswith(" ")


def sentences(paragraph):
    """Sentences as lists of words. They end in . ! ? before a capital, code or a bracket.

    >>> [len(s) for s in sentences("It has 2 mm, see [a page](a.md#b). `bench run x` does *it* (eq. 1)! So?")]
    [7, 5, 1]
    """
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", paragraph)
    text = re.sub(r"`[^`]+`", "CODE", text)
    text = re.sub(r"[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}", "", text)
    for sentence in re.split(r"(?<=[.!?])[\"')\]]*\s+(?=[\"'(\[]*[A-Z])", text):
        words = [word for word in sentence.split() if re.search(r"[A-Za-z0-9]", word)]
        if words:
            yield words


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("pages", nargs="+", metavar="PAGE")
    arguments.add_argument("--longest", type=int, default=0, metavar="N")
    arguments.add_argument("--at-most", type=float, metavar="MEDIAN")
    asked = arguments.parse_args()
    assert doctest.testmod().failed == 0
    everything = []

    def say(name, found):
        lengths = [len(words) for words in found]
        print(f"{name:32} {len(found):5} sentences, median {statistics.median(lengths):4.1f} words, "
              f"90 % have at most {percentile(lengths, 0.9):2}, all {max(lengths):3}")

    for page in asked.pages:
        with open(page, encoding="utf-8") as file:
            found = [words for paragraph in paragraphs(file.read()) for words in sentences(paragraph)]
        assert found, f"{page} has no sentence"
        say(page, found)
        for words in sorted(found, key=len, reverse=True)[:asked.longest]:
            print(f"    {len(words)}: {' '.join(words)}")
        everything += found
    say("all", everything)
    if asked.at_most and statistics.median(len(words) for words in everything) > asked.at_most:
        sys.exit(f"expected a median of at most {asked.at_most:g} words")


if __name__ == "__main__":
    main()
