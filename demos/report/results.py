#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes docs/results.md, the tables of all measurements, with the report's own parts. ./cairn.sh results calls it."""
import argparse
import json
import sys
import time
from pathlib import Path

import alone
import keys
import machine
import markdown
import measure
import parts
import tables

OPENING = """# Results

This page is for readers who want figures: how fast, how exact, how steady, on which machine. `./cairn.sh results` measures them and writes this page; nobody edits it.

Each section says when, on which commit and by which command it was measured. Times hold for that machine and hour: compare ratios within a section.
`./cairn.sh results --only NAME` measures one section again and leaves the others as they are. A section that was never measured is named as missing.
"Quick" sections are of fewer models, bodies or seconds than whole ones.
"Carried over" sections are older tables that were not measured again, with their date.
Lengths in per cent of size are fractions of a mesh's bounding-box diagonal. [The glossary](glossary.md) explains the other terms.
"""

SAME_QUICK = ("textbook", "laws")  # kinds that --quick makes no shorter


def options():
    parser = argparse.ArgumentParser(
        prog="cairn.sh results", description="Measures, and writes the page of results section by section: what is not measured now stays as it is on the page.",
        epilog="Examples:\n  all of it, an hour or more:  ./cairn.sh results\n  some minutes:                ./cairn.sh results --quick\n"
               "  one table again:             ./cairn.sh results --only heap", formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="fewer models, bodies and seconds")
    parser.add_argument("--only", default="", metavar="SECTIONS", help="measure these alone, separated by commas")
    parser.add_argument("--list", action="store_true", help="name the sections and end")
    parser.add_argument("-o", "--output", default="docs/results.md", metavar="PAGE", help="default: docs/results.md")
    parser.add_argument("--data", default="out/results", metavar="DIR", help="where measurements are kept (default: out/results)")
    parser.add_argument("--models", default="", metavar="DIR", help="meshes for the experiments instead of the thesis's")
    parser.add_argument("--archive", default=parts.ARCHIVE, help="of meshes (libcgal-demo)")
    parser.add_argument("--programs", default="build/release/bin", metavar="DIR", help="default: build/release/bin")
    return parser.parse_args()


def complain(why, code):
    print(f"results: {why}", file=sys.stderr)
    return code


def with_needs(plan, chosen):
    """The chosen parts and those whose files they take; none chosen: all."""
    by_name = {part.name: part for part in plan}
    return {name for one in chosen for name in [one, *by_name[one].needs]} if chosen else set(by_name)


def title_of(name, kind, title):
    """Experiments have long titles; their names stand in the contents."""
    return f"Experiment {name}" if kind == "experiment" else title


def measured(part, quick, data, about):
    """The section of a part that is done."""
    made = part["made"]
    how = "quick" if "--quick" in part["command"] or (quick and part["kind"] not in SAME_QUICK) else "whole"
    said = (f"Measured {made['date']} in {tables.number(part['seconds'])} s on commit {made['commit'][:12]}{' with changes' if 'changes' in made['commit'] else ''};"
            f" {made['cpu']}, {about['Cores']} cores, load {made['load']}.")
    title = title_of(part["name"], part["kind"], part["title"])
    text = f"## {title}\n\n{said}\n\n```\n{part['command']}\n```\n\n{markdown.of_part(part, data)}\n"
    return markdown.Section(part["name"], title, made["date"].partition(" ")[0], how, text)


def missing(part):
    title = title_of(part.name, part.kind, part.title)
    text = f"## {title}\n\n**Missing:** it was not measured yet. `./cairn.sh results --only {part.name}` measures it.\n"
    return markdown.Section(part.name, title, text=text)


def concluded(records, data, old):
    """What the experiments that are there say of the thesis's conclusions. A few of them take nothing back that more said before."""
    experiments, all_of_them = {}, sum(record["kind"] == "experiment" for record in records.values())
    for name, record in records.items():
        if record["kind"] == "experiment" and record["state"] == "done":
            document = json.loads((data / f"{name}.json").read_text(encoding="utf-8"))
            experiments[name] = {"document": document, "rows": tables.read_csv(data / document.get("csv", f"{name}.csv"))}
    title = "The thesis's conclusions"
    if not experiments or (old and old.how != "missing" and len(experiments) < all_of_them):
        return old or markdown.Section("conclusions", title, text=f"## {title}\n\n**Missing:** no experiment was measured yet.\n")
    days = sorted(records[name]["made"]["date"].partition(" ")[0] for name in experiments)
    said = "[Whole runs](#the-thesiss-experiments-whole-runs) decide where they differ."
    text = f"## {title}\n\nDrawn by rules from the experiments below: {', '.join(experiments)}. {said}\n\n{markdown.of_conclusions(experiments)}\n"
    return markdown.Section("conclusions", title, days[-1], "from experiments", text)


def sections_now(plan, records, chosen, old, quick, data, about):
    """All sections in the plan's order, and why some could not be made."""
    result, failures = [], []
    for part in plan:
        if part.kind == "model":
            continue
        record, section = records[part.name], None
        if part.name in chosen and record["state"] == "done":
            try:
                section = measured(record, quick, data, about)
            except (OSError, ValueError, KeyError, IndexError, TypeError) as failure:
                record |= {"state": "failed", "why": f"what it left cannot be read ({type(failure).__name__}: {failure})"}
        if part.name in chosen and not section:
            failures.append(f"{part.name} ({record['why']})")
        if part.kind == "experiment" and not any(s.name == "conclusions" for s in result):
            result.append(concluded(records, data, old.get("conclusions")))
        result.append(section or old.get(part.name) or missing(part))
    return result, failures


def kept_whole_ones(sections, old):
    """Sections that a quick plan has not, whole runs of the hard cases for one, stay on the page behind their short ones."""
    names = {section.name for section in sections}
    for name, section in old.items():
        if name not in names:
            before = [i for i, s in enumerate(sections) if name.startswith(s.name)]
            sections.insert(before[-1] + 1 if before else len(sections), section)
    return sections


def written(page, sections):
    lacking = [section.name for section in sections if section.how == "missing"]
    note = f"\nMissing: {', '.join(lacking)}.\n" if lacking else ""
    keys.written_whole(page, f"{OPENING}{note}\n{markdown.contents(sections)}\n\n" + "\n".join(section.marked() for section in sections))


def results(asked, source, data, lock):
    programs, page = Path(asked.programs).resolve(), Path(asked.output).resolve()
    plan = parts.Plan(source, programs, data, asked.quick, asked.models and str(Path(asked.models).resolve()), asked.archive).results()
    names = [part.name for part in plan if part.kind != "model"]
    if asked.list:
        print("\n".join(names))
        return 0
    asked_for = {name for name in asked.only.split(",") if name}
    if unknown := asked_for - set(names):
        return complain(f"there is no section {sorted(unknown)[0]}; they are {', '.join(names)}", 2)
    chosen, about, begun = with_needs(plan, asked_for), machine.describe(source, programs.parent), time.monotonic()
    measuring = measure.Measuring(data, source, None, about, "./cairn.sh results", lock)
    measuring.forget_other_models(programs / "accuracy_cost", asked.archive)
    try:
        records = measuring.all(plan, chosen)
    except measure.Cancelled:
        return complain("cancelled; the page is as it was, and the same command goes on from here.", 130)
    old = markdown.sections_of(page.read_text(encoding="utf-8")) if page.exists() else {}
    sections, failures = sections_now(plan, records, asked_for or set(names), old, asked.quick, data, about)
    written(page, kept_whole_ones(sections, old))
    print(f"{page}, {measure.clock(time.monotonic() - begun)}")
    return complain(f"not measured: {'; '.join(failures)}; these sections are as they were.", 1) if failures else 0


def main():
    asked = options()
    data = Path(asked.data).resolve() / ("quick" if asked.quick else "whole")
    if why := measure.refusal(asked, Path(asked.output).resolve().parent, data):
        return complain(why, 1)
    with alone.locked(data) as lock:
        if lock is None:
            return complain(f"another run is at work in {data}; wait for it, end it, or name another folder with --data", 1)
        return results(asked, Path(__file__).resolve().parents[2], data, lock)


if __name__ == "__main__":
    sys.exit(main())
