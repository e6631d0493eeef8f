# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the page: cells as they are read, headers with units."""
import csv
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

# Endings of a column's name, what they are as a unit, and what a value is multiplied by.
UNITS = [("_fraction_squared", "of size²", 1), ("_fraction", "%", 100), ("_share", "%", 100), ("_percent", "%", 1),
         ("_us", "µs", 1), ("_ms", "ms", 1), ("_s", "s", 1), ("_mb", "MB", 1), ("_ratio", "ratio", 1), ("_rad", "rad", 1)]


@dataclass
class Column:
    name: str
    unit: str = ""
    numbers: bool = True


@dataclass
class Table:
    caption: str
    columns: list
    rows: list = field(default_factory=list)  # of texts, as many as columns
    left: int = 0  # rows that are not shown
    note: str = ""  # below it, on the page of results


def number(value, digits=3):
    """A number with so many digits that mean something."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if value == 0:
        return "0"
    if float(value).is_integer() and abs(value) < 1e15:
        return f"{int(value):,}".replace(",", "\u202f")
    if abs(value) >= 10 ** digits:
        return f"{value:,.0f}".replace(",", "\u202f")
    if abs(value) < 1e-4:
        return f"{value:.{digits - 1}e}"
    return f"{value:.{max(0, digits - 1 - math.floor(math.log10(abs(value))))}f}"


def _parsed(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def heading(name):
    """A column's name as words, its unit, its factor."""
    for ending, unit, factor in UNITS:
        if name.endswith(ending):
            return name[:-len(ending)].replace("_", " "), unit, factor
    return name.replace("_", " "), "", 1


def read_csv(path):
    try:
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    except OSError:
        return []


def from_rows(rows, caption, most):
    """The first rows of a CSV file; a column is of numbers when all its cells are, but models' names are texts whatever they
    look like."""
    if not rows:
        return None
    shown, columns, factors = rows[:most], [], []
    for name in rows[0]:
        words, unit, factor = heading(name)
        numbers = name != "model" and all(_parsed(r[name]) is not None or not r[name] for r in shown)
        columns.append(Column(words, unit if numbers else "", numbers))
        factors.append(factor)
    table = Table(caption, columns, left=len(rows) - len(shown))
    for row in shown:
        cells = []
        for (name, text), column, factor in zip(row.items(), columns, factors):
            value = _parsed(text) if column.numbers else None
            cells.append(text if not column.numbers else "" if not text else number(value * factor if factor != 1 else value))
        table.rows.append(cells)
    return table


def textbook(document):
    """One line an experiment, error and time of each shape."""
    shapes = list(document[0]["shapes"])
    columns = [Column("experiment", numbers=False), Column("exact")]
    for shape in shapes:
        columns += [Column(f"{shape}: error", "%"), Column(f"{shape}: a step", "µs")]
    table = Table("Error against the exact answer, and CPU time of a step", columns)
    for line in document:
        cells = [f"{line['experiment']} {line['quantity']}", number(line["exact"], 4)]
        for shape in shapes:
            of = line["shapes"][shape]
            cells += [f"{100 * of['error_fraction']:.2f}", f"{of['step_us']:.1f}"]
        table.rows.append(cells)
    return table


SHAPES_NOTE = ("`tree` is a sphere-tree with contacts of meshes, `tree+leaves` one with contacts of leaves (`Finest::leaves`). `hull` is the mesh's convex hull, with a margin of 1 % of size. "
               "`spheres` is a Bullet compound of the spheres of the tree's level 2. `gimpact` is Bullet's GImpact, with a margin of 0.1 % of size. "
               "`fcl` is the Flexible Collision Library on all triangles; it only answers recorded poses.")
ERROR_NOTE = ("The [certified error](glossary.md#certified-error) of a contact of meshes is at most its depth. "
              "So the maximum of `tree` is the deepest contact of one step, not a gap, and may exceed that of `tree+leaves`.")
MEDIAN_NOTE = "The median is over all steps, also those in which all bodies sleep and cost next to nothing: a heap that sleeps early, as hulls do, has a low one."

HEAP_LINES = [
    ("Narrow phase, median", "µs CPU a step", "narrow_phase_cpu_us.median", 1), ("Narrow phase, 99 %", "µs CPU a step", "narrow_phase_cpu_us.p99", 1),
    ("Whole step, median", "µs CPU", "step_cpu_us.median", 1), ("Whole step, 99 %", "µs CPU", "step_cpu_us.p99", 1),
    ("Operations a step, median", "operations", "operations.median", 1),
    ("Certified error, mean", "% of size", "certified_error_fraction.mean", 100), ("Certified error, max", "% of size", "certified_error_fraction.max", 100),
    ("Contacts, median", "points", "contacts.median", 1),
    ("Penetration of bodies at the end, mean", "% of size", "penetration_end_fraction.mean", 100),
    ("Penetration of bodies at the end, max", "% of size", "penetration_end_fraction.max", 100),
    ("Gap under load at the end, mean", "% of size", "gap_end_fraction.mean", 100), ("Gap under load at the end, max", "% of size", "gap_end_fraction.max", 100),
    ("Kinetic energy at the end", "J/kg", "kinetic_energy_end_j_per_kg", 1),
    ("Bodies asleep", "bodies", "bodies_asleep", 1), ("Bodies lost", "bodies", "bodies_lost", 1)]


def _at(document, path):
    for key in path.split("."):
        document = document.get(key) if isinstance(document, dict) else None
    return document


def heap(document):
    """One column a shape, and how many times the tree's narrow phase its own takes."""
    first = document[0]
    table = shapes_beside(document, f"{first['bodies']} bodies of {first['mesh']} ({first['tree']['triangles']} triangles), {first['steps']} steps of 1/60 s", HEAP_LINES)
    medians = [_at(run, "narrow_phase_cpu_us.median") for run in document]
    table.note = f"{SHAPES_NOTE}\n\n{ERROR_NOTE} {MEDIAN_NOTE}"
    table.rows.insert(2, ["Narrow phase over the tree's, median", "ratio"] + [number(m / medians[0]) for m in medians])
    return table


def shapes_beside(document, caption, lines):
    """A line a measure, a column a shape. `lines`: label, unit, path in the JSON, factor."""
    table = Table(caption, [Column("", numbers=False), Column("unit", numbers=False)] + [Column(run["shape"]) for run in document])
    for label, unit, path, factor in lines:
        values = [_at(run, path) for run in document]
        if any(v is not None for v in values):
            table.rows.append([label, unit] + [number(None if v is None else v * factor) for v in values])
    return table


CONVERGE_LINES = [
    ("Narrow phase, median", "µs CPU a frame", "narrow_phase_cpu_us.median", 1), ("Narrow phase, 99 %", "µs CPU a frame", "narrow_phase_cpu_us.p99", 1),
    ("Certified error, mean", "% of size", "certified_error_fraction.mean", 100), ("Certified error, max", "% of size", "certified_error_fraction.max", 100),
    ("Contact error, mean", "% of size", "contact_error_fraction.mean", 100), ("Contact error, 99 %", "% of size", "contact_error_fraction.p99", 100),
    ("Pairs that meet", "pairs", "true_pairs", 1), ("Pairs missed", "pairs", "missed_pairs", 1), ("Deepest pair missed", "% of size", "missed_depth_fraction.max", 100),
    ("Missed deeper than the certified error", "pairs", "missed_beyond_certified_error", 1)]


def converge(document):
    first = document[0]
    table = shapes_beside(document, f"{first['bodies']} bodies of {first['mesh']} ({first['tree']['triangles']} triangles) fly to one point, {first['runs']} runs; every shape sees the same poses", CONVERGE_LINES)
    table.note = f"{SHAPES_NOTE}\n\n{ERROR_NOTE}"
    return table


def laws(document):
    """One line a law: how far the measured value is from the exact one, over all masses and steps."""
    ratios = {}
    for line in document:
        ratios.setdefault(line["law"], []).append(line["measured_over_exact"])
    table = Table(f"Measured over exact, least and most over {len({line['mass_kg'] for line in document})} masses and {len({line['step_s'] for line in document})} steps",
                  [Column("law", numbers=False), Column("least"), Column("most")])
    table.rows = [[law, f"{min(values):.5f}", f"{max(values):.5f}"] for law, values in ratios.items()]
    return table


def builder(path):
    """What tests/bench/builder.sh prints."""
    lines = Path(path).read_text(encoding="utf-8").splitlines()
    table = Table("Median of the runs, one thread", [
        Column("mesh", numbers=False), Column("method", numbers=False), Column("CPU", "s"), Column("least to most", "s"), Column("elapsed", "s"),
        Column("memory", "MB"), Column("author's toolkit", "s"), Column("ours over it", "ratio"), Column("tree (SHA-256)", numbers=False)])
    for line in lines[1:]:
        cells = re.sub(r"(\d)-\s*(\d)", r"\1–\2", line).split()
        if len(cells) == len(table.columns):
            table.rows.append(["–" if c == "-" else c for c in cells])
        elif cells:
            table.rows.append(cells[:2] + ["failed"] + [""] * (len(table.columns) - 3))
    return table
