#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the page of a report from what its parts left: page.py DATA PAGE. Draws no conclusion that has no rule."""
import base64
import json
import os
import sys
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

import conclusions
import glance
import tables

MOST_ROWS = 60  # of a table on the page; the whole of it is there to be saved
MOST_SVG_BYTES = 350_000  # of a figure; its PNG stands in for a larger one
DOCUMENT_KEYS = ("experiment", "title", "thesis_section", "thesis_says", "we_found", "verdict", "why", "differs", "claims", "figures", "models", "left_out", "seconds")
KINDS = {".svg": "image/svg+xml", ".png": "image/png", ".csv": "text/csv", ".json": "application/json"}
# A shape beside each word, so that colour is never alone.
SHAPES = {conclusions.REPRODUCED: ("yes", "●"), conclusions.IN_PART: ("part", "◐"), conclusions.NOT: ("no", "○"),
          conclusions.UNKNOWN: ("none", "–"), conclusions.UNDECIDED: ("none", "–"),
          conclusions.HOLDS: ("yes", "●"), conclusions.HOLDS_IN_PART: ("part", "◐"), conclusions.HOLDS_NOT: ("no", "○"),
          "as good as stock": ("part", "◐"), "misses": ("no", "○")}


def data_uri(path):
    encoded = base64.b64encode(path.read_bytes()).decode("ascii")
    return Markup(f"data:{KINDS[path.suffix]};base64,{encoded}")


def shape_of(verdict):
    return SHAPES.get(verdict, ("none", "–"))


def read_json(path):
    return json.loads(path.read_text(encoding="utf-8"))


def figures_of(document, data):
    """One picture a figure: SVG, or PNG where that is much smaller."""
    stems = dict.fromkeys(Path(name).stem for name in document.get("figures", []))
    found = []
    for stem in stems:
        files = [data / f"{stem}{ending}" for ending in (".svg", ".png")]
        files = [f for f in files if f.exists()]
        if not files:
            continue
        small = [f for f in files if f.suffix == ".png" or f.stat().st_size <= MOST_SVG_BYTES]
        found.append({"name": stem, "uri": data_uri((small or files)[0])})
    return found


def experiment_of(part, data):
    """What the page shows of an experiment."""
    document = read_json(data / f"{part['name']}.json")
    for key in DOCUMENT_KEYS:
        document[key]  # KeyError: it is none of accuracy_cost's
    csv = data / document.get("csv", f"{part['name']}.csv")
    rows = tables.read_csv(csv)
    return {"document": document, "rows": rows, "figures": figures_of(document, data), "csv": data_uri(csv) if csv.exists() else "",
            "csv_name": csv.name, "table": tables.from_rows(rows, f"{len(rows)} rows", MOST_ROWS)}


def glance_of(rows, data):
    """The figure and the sentences of the first screen; nothing where the table lacks what they are made of."""
    model, picture = rows[0]["model"], data / "what-accuracy-costs.svg"
    try:
        points = glance.points_of(rows, model, "heap")
        glance.draw(points, picture)
    except (glance.Unusable, OSError) as failure:
        return {"why": str(failure)}
    return {"uri": data_uri(picture), "title": glance.title_of(points), "sentences": glance.sentences_of(points, model, "heap")}


def gallery_of(done, data):
    """Contact sheets: by model, its sets of spheres and its trees, method by method."""
    sheets = {}
    for part in done:
        if part["kind"] in ("tree", "sphere-sets"):
            kind, model = ("sets", part["name"].rsplit("-", 1)[1]) if part["kind"] == "sphere-sets" else ("trees", part["name"].split("-")[1])
            sheet = sheets.setdefault(model, {"model": model, "sets": [], "trees": []})
            label = "" if kind == "sets" else part["name"].split("-", 2)[2]
            sheet[kind].append(part | {"label": label, "uri": data_uri(data / part["outputs"][0])})
    return list(sheets.values())


def hard_cases_of(document):
    """As rows, whatever else stands in it; a value may be a text or a number."""
    said = lambda value: tables.number(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else str(value)
    return [{key: said(case.get(key, "–")) for key in ("id", "name", "criterion", "measured", "stock", "verdict", "why")} for case in document["cases"]]


def made(part, make):
    """What is shown of a part that is done; one whose file is not what it should be has failed, and says so."""
    if part is None or part["state"] != "done":
        return None
    try:
        return make()
    except (OSError, ValueError, KeyError, IndexError, TypeError, AttributeError) as failure:
        part |= {"state": "failed", "why": f"what it left cannot be read ({type(failure).__name__}: {failure})"}
        return None


def content_of(run, data):
    """All that the template shows. Marks parts whose files cannot be read as failed."""
    parts = {part["name"]: part for part in run["parts"]}
    experiments = {}
    for part in run["parts"]:
        if part["kind"] == "experiment" and (found := made(part, lambda: experiment_of(part, data))):
            experiments[part["name"]] = found
    accuracy = experiments.get("error-against-time")
    shown = {"glance": glance_of(accuracy["rows"], data) if accuracy and accuracy["rows"] else None}
    shown |= {name: made(parts.get(name), make) for name, make in (
        ("textbook", lambda: tables.textbook(read_json(data / "textbook.json"))),
        ("heap", lambda: tables.heap(read_json(data / "heap.json"))),
        ("builder", lambda: tables.builder(data / "builder.txt")))}
    shown["hard_cases"] = made(parts.get("hard-cases"), lambda: hard_cases_of(read_json(data / "hard-cases.json")))
    gallery = gallery_of([part for part in run["parts"] if part["state"] == "done"], data)
    judged = conclusions.judged(experiments)
    verdicts = [e["document"].get("verdict", conclusions.UNKNOWN) for e in experiments.values()]
    done = [part for part in run["parts"] if part["state"] == "done"]
    return {
        "run": run, "parts": parts, "done": len(done), "kept": [part for part in done if part.get("kept")], "experiments": experiments, "conclusions": judged,
        "asked": [part for part in run["parts"] if part["kind"] == "experiment"],
        "missing": [part for part in run["parts"] if part["state"] != "done"],
        "counts": [(v, verdicts.count(v)) for v in SHAPES if verdicts.count(v)],
        "gallery": gallery, **shown,
    }


def render(run, data):
    here = Path(__file__).resolve().parent
    environment = Environment(loader=FileSystemLoader(here), autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters["sentence"] = lambda text: text[:1].upper() + text[1:]
    environment.filters["shape"] = shape_of
    environment.filters["number"] = tables.number
    environment.filters["claims_told"] = lambda claims: conclusions.told([claim["standing"] for claim in claims], "claim")
    style = Markup((here / "report.css").read_text(encoding="utf-8"))
    return environment.get_template("report.html.j2").render(style=style, **content_of(run, data))


def write(data, page):
    """Written whole or not at all. `data` holds run.json and what it names. The names of all parts that are not on it."""
    data, page = Path(data), Path(page)
    run = json.loads((data / "run.json").read_text(encoding="utf-8"))
    partial = page.with_suffix(".partial")
    partial.write_text(render(run, data), encoding="utf-8")
    os.replace(partial, page)
    return [part["name"] for part in run["parts"] if part["state"] in ("failed", "left out")]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: page.py DATA PAGE")
    write(sys.argv[1], sys.argv[2])
