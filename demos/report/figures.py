#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a table of the README as Markdown: figures.py heap|converge JSON, of frame_budget's figures. ./cairn.sh figures calls it."""
import json
import sys
from pathlib import Path

NAMES = {"tree": "sphere-tree", "tree+leaves": "contacts at leaves", "gimpact": "GImpact", "hull": "hull", "fcl": "FCL", "spheres": "spheres", "compound": "compound"}


def milliseconds(run, quantiles):
    return " / ".join(f"{run['narrow_phase_cpu_us'][q] / 1000:.{digits}f}" for q, digits in quantiles)


def percent(run, key, quantiles):
    values = [run[key][q] for q in quantiles]
    return "–" if None in values else " / ".join(f"{100 * value:.2f}" for value in values)


HEAP = [("narrow phase, CPU ms a step: median / 99 %", lambda run: milliseconds(run, (("median", 1), ("p99", 1)))),
        ("penetration of the meshes at the end, % of size: mean / max", lambda run: percent(run, "penetration_end_fraction", ("mean", "max"))),
        ("gap between bodies that carry load, % of size: mean", lambda run: percent(run, "gap_end_fraction", ("mean",))),
        ("asleep at the end", lambda run: f"{run['bodies_asleep']} of {run['bodies']}")]
CONVERGE = [("narrow phase, CPU ms a frame: median / 99 %", lambda run: milliseconds(run, (("median", 2), ("p99", 2)))),
            ("error of contacts, % of size: mean / 99 %", lambda run: percent(run, "contact_error_fraction", ("mean", "p99"))),
            ("pairs missed", lambda run: f"{run['missed_pairs']} of {run['true_pairs']}")]


def table(lines, runs):
    rows = [["", *(NAMES.get(run["shape"], run["shape"]) for run in runs)], ["---", *(["--:"] * len(runs))]]
    rows += [[label, *map(value, runs)] for label, value in lines]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in rows)


def main():
    kinds = {"heap": HEAP, "converge": CONVERGE}
    if len(sys.argv) != 3 or sys.argv[1] not in kinds:
        print(f"usage: figures.py {'|'.join(kinds)} JSON", file=sys.stderr)
        return 2
    try:
        document = json.loads(Path(sys.argv[2]).read_text(encoding="utf-8"))
        print(table(kinds[sys.argv[1]], document if isinstance(document, list) else [document]))
    except (OSError, ValueError, KeyError, TypeError) as failure:
        print(f"figures: {sys.argv[2]} has no figures of frame_budget ({type(failure).__name__}: {failure}); make it again with --json", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
