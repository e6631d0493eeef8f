# SPDX-License-Identifier: GPL-3.0-or-later
"""A page of results as Markdown: tables, and sections that can be replaced one at a time."""
import json
import re
from dataclasses import dataclass

import conclusions
import tables

COSTS = ("s", "s of CPU", "MB", "KiB")  # units of measures that say what a case takes, not what comes out
MAX_MEASURES = 3  # of a hard case in its line; its JSON has all
SECTION = re.compile(r"<!-- section: (?P<name>[\w-]+); measured: (?P<date>[^;\n]*); how: (?P<how>[^;\n]*) -->\n(?P<text>.*?)<!-- /section -->\n", re.DOTALL)


@dataclass
class Section:
    name: str
    title: str
    date: str = ""  # day of the measurement; none: it is missing
    how: str = "missing"
    text: str = ""  # Markdown, its heading included

    def marked(self):
        return f"<!-- section: {self.name}; measured: {self.date}; how: {self.how} -->\n{self.text.rstrip()}\n<!-- /section -->\n"


def cell(text):
    """Text that cannot end its cell, its row or its table."""
    return re.sub(r"\s+", " ", str(text)).strip().replace("|", "\\|")


def row(cells):
    return f"| {' | '.join(map(cell, cells))} |"


def of_table(table):
    """A tables.Table."""
    names = [f"{column.name} ({column.unit})" if column.unit else column.name for column in table.columns]
    lines = [row(names), row(["--:" if column.numbers else "---" for column in table.columns]), *map(row, table.rows)]
    if table.left:
        lines += ["", f"{table.left} more rows are in the file."]
    if table.note:
        lines += ["", table.note]
    return f"{table.caption}:\n\n" + "\n".join(lines)


def closeness(measure):
    """How near a measure is to its limit; from 1 on it misses."""
    value, limit = float(measure["value"]), float(measure["limit"])
    if measure["bound"] == ">=":
        value, limit = limit, value
    return value / limit if limit else (float("inf") if value > 0 else 0.0)


def deciding(case):
    """The measures that a hard case's verdict hangs on: those that miss, else the outcome nearest to its limit."""
    measures = sorted(case["measures"], key=closeness, reverse=True)
    missed = [measure for measure in measures if measure["verdict"] != "holds"]
    outcomes = [measure for measure in measures if measure["unit"] not in COSTS]
    return (missed or outcomes[:1] or measures[:1])[:MAX_MEASURES]


def measure_of(measure):
    stock, unit = measure.get("stock"), f" {measure['unit']}" if measure["unit"] else ""
    beside = f"; {stock['shape']} {tables.number(stock['value'])}" if stock else ""
    return f"{measure['name']}: {tables.number(measure['value'])}{unit} ({measure['bound']} {tables.number(measure['limit'])}{beside})"


def of_hard_cases(document):
    """One line a case: criterion, the measures that decide, verdict and why."""
    lines = ["The measure in a line is the outcome nearest to its limit, or those that miss. Its limit is in brackets, with the best of Bullet's own shapes.", "",
             row(["case", "criterion", "measure (limit; Bullet's best)", "verdict", "why"]), row(["---"] * 5)]
    for case in document["cases"]:
        why = case["why"] if case["verdict"] != "holds" else ""
        lines.append(row([f"{case['id']} {case['name']}", case["criterion"].replace(" (proposed list)", ""), "; ".join(map(measure_of, deciding(case))), case["verdict"], why]))
    verdicts = [case["verdict"] for case in document["cases"]]
    counts = ", ".join(f"{v} {verdicts.count(v)}" for v in dict.fromkeys(verdicts))
    return "\n".join([*lines, "", f"Verdicts of {len(verdicts)} cases: {counts}."])


def of_experiment(document):
    """Its claims, each with rule, figure and verdict."""
    title = document["title"]
    lines = [f"{title[:1].upper()}{title[1:]}. Thesis {document['thesis_section']}. Verdict: **{document['verdict']}**.", ""]
    if document["claims"]:
        lines += [row(["claim", "rule", "found", "verdict"]), row(["---"] * 4)]
        for claim in document["claims"]:
            lacking = f"; {claim['lacking_text']}" if claim.get("lacking_text") else ""
            lines.append(row([claim["thesis"], claim["rule"], claim["found"] + lacking, claim["standing"]]))
    else:
        lines.append(f"{document['we_found']} {document['why']}")
    models = ", ".join(f"{model['name']} ({model['triangles']} triangles)" for model in document["models"])
    return "\n".join([*lines, "", f"Models: {models}."])


def of_part(part, data):
    """What a part left, as Markdown. Raises what reading raises where it is not what it should be."""
    path = data / part["outputs"][0]
    kind = part["kind"]
    if kind == "printed":
        return re.sub(r"^#", "##", re.sub(r"\nThe figure: .*", "", path.read_text(encoding="utf-8")).strip(), flags=re.MULTILINE)
    if kind == "builder":
        return of_table(tables.builder(path))
    document = json.loads(path.read_text(encoding="utf-8"))
    if kind == "experiment":
        return of_experiment(document)
    if kind == "hard-cases":
        return of_hard_cases(document)
    return of_table({"textbook": tables.textbook, "heap": tables.heap, "converge": tables.converge, "laws": tables.laws}[kind](document))


def of_conclusions(experiments):
    """The thesis's conclusions by how their points stand. `experiments`: by name, as conclusions.judged takes them."""
    lines = [row(["conclusion of the thesis's section 8.1", "point", "standing"]), row(["---"] * 3)]
    for conclusion in conclusions.judged(experiments):
        lines.append(row([f"{conclusion.number}. {conclusion.title}", conclusion.told(), conclusion.verdict]))
        lines += [row(["", point.says + (" (ours, does not count)" if point.own else ""), point.standing]) for point in conclusion.points]
    return "\n".join(lines)


def sections_of(page):
    """The sections of an earlier page, by name."""
    return {found["name"]: Section(found["name"], heading_of(found["text"]), found["date"], found["how"], found["text"]) for found in SECTION.finditer(page)}


def heading_of(text):
    return text.partition("\n")[0].lstrip("# ").strip()


def anchor(title):
    """As GitHub and MkDocs make it of a heading."""
    return re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-")


def contents(sections):
    lines = [row(["section", "measured", "how"]), row(["---"] * 3)]
    return "\n".join(lines + [row([f"[{s.title}](#{anchor(s.title)})", s.date or "**missing**", s.how]) for s in sections])
