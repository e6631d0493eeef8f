#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the tables of a page with what their commands print: check.py [PAGE...] (default README.md).

A table stands between <!-- figures: COMMAND --> and <!-- /figures -->. COMMAND is run from the checkout; it prints a Markdown
table. Cells are found by their row's first cell and their column's heading. Every cell must be the same text, but times:
in rows or columns whose name has a unit of time, figures may differ by the factor that the block states to its readers in
the words "within a factor of N".
"""
import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"<!-- figures: (?P<command>.+?) -->\n(?P<text>.*?)<!-- /figures -->", re.DOTALL)
TIME = re.compile(r"(^|[\s(])(ms|µs|us|milliseconds|microseconds|s CPU|CPU s)([\s):,]|$)")
FACTOR = re.compile(r"within a factor of (\d+(?:\.\d+)?)")
FIGURE = re.compile(r"-?\d+(?:\.\d+)?")
DIVIDER = re.compile(r"^\|[\s:|-]+\|$")


def table_of(text):
    """Cells of the first Markdown table in a text, by (row's first cell, column's heading); empty without one."""
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in text.splitlines()
            if line.strip().startswith("|") and not DIVIDER.match(line.strip())]
    if len(rows) < 2:
        return {}
    return {(cells[0], heading): cell for cells in rows[1:] for heading, cell in zip(rows[0][1:], cells[1:])}


def close(stands, printed, factor):
    """Whether two cells of times have the same words, and figures that differ by no more than the factor."""
    if FIGURE.sub("#", stands) != FIGURE.sub("#", printed):
        return False
    for one, other in zip(map(float, FIGURE.findall(stands)), map(float, FIGURE.findall(printed))):
        if one != other and not (one > 0 and other > 0 and max(one, other) <= factor * min(one, other)):
            return False
    return True


def differences(text, printed):
    """What is wrong with a block, a sentence each."""
    stands, prints = table_of(text), table_of(printed)
    if not stands:
        return ["the block has no table"]
    if not prints:
        return ["the command prints no Markdown table"]
    factor, found = FACTOR.search(text), []
    for place, cell in stands.items():
        is_time = any(TIME.search(name) for name in place)
        if place not in prints:
            found.append(f"'{place[0]}', '{place[1]}': the command prints no such cell")
        elif is_time and not factor:
            found.append(f"'{place[0]}' is a time; state its spread in the block: within a factor of N")
        elif not (close(cell, prints[place], float(factor[1])) if is_time else cell == prints[place]):
            found.append(f"'{place[0]}', '{place[1]}': the page says {cell}, the command prints {prints[place]}")
    return list(dict.fromkeys(found))


def check(page):
    """Number of blocks, and what is wrong with them."""
    found, blocks = [], list(BLOCK.finditer(page.read_text(encoding="utf-8")))
    for block in blocks:
        print(f"{page.name}: {block['command']}", file=sys.stderr, flush=True)
        done = subprocess.run(["bash", "-c", block["command"]], cwd=SOURCE, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode:
            found.append(f"{page.name}: {block['command']} ended with {done.returncode}")
            continue
        found += [f"{page.name}: {each}" for each in differences(block["text"], done.stdout)]
    return len(blocks), found


def main():
    if "--help" in sys.argv or "-h" in sys.argv:
        print(__doc__)
        return 0
    pages = [Path(name) for name in sys.argv[1:]] or [SOURCE / "README.md"]
    blocks, found = 0, []
    for page in pages:
        if not page.is_file():
            print(f"check-figures: {page} is not there; name a Markdown page", file=sys.stderr)
            return 2
        number, wrong = check(page)
        blocks, found = blocks + number, found + wrong
    for each in found:
        print(f"check-figures: {each}", file=sys.stderr)
    if not blocks:
        print("check-figures: no table stands between <!-- figures: COMMAND --> and <!-- /figures -->", file=sys.stderr)
        return 1
    print(f"{blocks} tables, {len(found)} differences")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
