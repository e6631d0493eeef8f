#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results: sections are replaced one at a time, what is missing is named. Runs no program of Cairn's."""
import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "demos/report"))
import markdown  # noqa: E402
import parts  # noqa: E402
import tables  # noqa: E402

LAWS = [{"law": "friction", "mass_kg": mass, "step_s": 0.01, "measured_over_exact": ratio} for mass, ratio in ((10, 0.5), (1000, 1.25))]


def program(folder, name, text):
    """A program that writes a file: the last word of its command names it."""
    path = folder / name
    path.write_text(f"#!/bin/sh\nfor last in \"$@\"; do :; done\ncat > \"$last\" <<'END'\n{text}\nEND\n", encoding="utf-8")
    path.chmod(0o755)
    return path


def run(folder, *more):
    return subprocess.run([sys.executable, str(SOURCE / "demos/report/results.py"), "--programs", str(folder / "bin"), "-o", str(folder / "page.md"),
                           "--data", str(folder / "data"), *more], capture_output=True, text=True, check=False, timeout=120)


class Page(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.folder = Path(self.scratch.name)
        (self.folder / "bin").mkdir()
        program(self.folder / "bin", "laws_bench", json.dumps(LAWS))
        listing = self.folder / "bin/accuracy_cost"  # it names no experiment
        listing.write_text("#!/bin/sh\n", encoding="utf-8")
        listing.chmod(0o755)

    def tearDown(self):
        self.scratch.cleanup()

    def page(self):
        return (self.folder / "page.md").read_text(encoding="utf-8")

    def test_names_what_is_missing(self):
        done = run(self.folder, "--only", "laws")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Missing: textbook, heap, converge, budgets, builder, trees, hard-cases, hard-cases-whole.", self.page())
        self.assertIn("`./cairn.sh results --only heap` measures it", self.page())
        self.assertIn("| friction | 0.50000 | 1.25000 |", self.page())

    def test_a_section_that_is_not_measured_stays_to_the_byte(self):
        run(self.folder, "--only", "laws")
        before = markdown.sections_of(self.page())["laws"].marked()
        program(self.folder / "bin", "textbook_bench", json.dumps([{"experiment": "R1", "quantity": "m", "exact": 2, "shapes": {"hull": {"error_fraction": 0.5, "step_us": 3}}}]))
        done = run(self.folder, "--only", "textbook")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(before, self.page())
        self.assertIn("| R1 m | 2 | 50.00 | 3.0 |", self.page())

    def test_a_measurement_that_fails_leaves_its_old_section_and_is_told(self):
        run(self.folder, "--only", "laws")
        before = markdown.sections_of(self.page())["laws"].marked()
        bench = self.folder / "bin/laws_bench"
        bench.write_text("#!/bin/sh\necho it broke >&2\nexit 1\n", encoding="utf-8")
        done = run(self.folder, "--only", "laws")
        self.assertEqual(done.returncode, 1)
        self.assertIn("laws (it broke)", done.stderr)
        self.assertIn(before, self.page())

    def test_whole_hard_cases_stay_where_only_short_ones_are_measured(self):
        old = markdown.Section("hard-cases-whole", "Hard cases, whole runs", "2026-01-01", "whole", "## Hard cases, whole runs\n\nkept\n")
        (self.folder / "page.md").write_text(old.marked(), encoding="utf-8")
        done = run(self.folder, "--quick", "--only", "laws")
        self.assertEqual(done.returncode, 0, done.stderr)
        names = list(markdown.sections_of(self.page()))
        self.assertEqual(names[names.index("hard-cases") + 1], "hard-cases-whole")
        self.assertIn(old.marked(), self.page())

    def test_refuses_a_section_that_is_none(self):
        done = run(self.folder, "--only", "lows")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no section lows; they are textbook, laws", done.stderr)
        self.assertFalse((self.folder / "page.md").exists())


class Notes(unittest.TestCase):
    def test_every_shape_of_the_heap_is_explained_below_its_table(self):
        runs = [{"shape": shape, "bodies": 1, "mesh": "m", "steps": 1, "tree": {"triangles": 4}, "narrow_phase_cpu_us": {"median": 1.0}} for shape in parts.SHAPES.split(",")]
        below = markdown.of_table(tables.heap(runs)).rpartition("|\n")[2]
        for shape in parts.SHAPES.split(","):
            self.assertIn(f"`{shape}`", below)


class HardCases(unittest.TestCase):
    @staticmethod
    def measure(name, value, limit, verdict, bound="<="):
        return {"name": name, "value": value, "bound": bound, "limit": limit, "unit": "%", "verdict": verdict, "stock": {"shape": "hull", "value": 2.0}}

    def case(self, *measures, verdict="holds"):
        return {"id": "D0", "name": "a | case", "criterion": "c", "verdict": verdict, "why": "because", "measures": list(measures)}

    def test_a_case_that_holds_shows_the_measure_nearest_its_limit(self):
        case = self.case(self.measure("far", 1.0, 10.0, "holds"), self.measure("near", 9.0, 10.0, "holds"), self.measure("at least", 20.0, 10.0, "holds", ">="))
        self.assertEqual([m["name"] for m in markdown.deciding(case)], ["near"])

    def test_time_is_shown_only_where_it_misses_or_is_all(self):
        late = self.measure("slowest answer", 9.0, 10.0, "holds") | {"unit": "s"}
        outcome = self.measure("points lost", 0.0, 0.0, "holds")
        self.assertEqual([m["name"] for m in markdown.deciding(self.case(late, outcome))], ["points lost"])
        self.assertEqual([m["name"] for m in markdown.deciding(self.case(late))], ["slowest answer"])
        self.assertEqual([m["name"] for m in markdown.deciding(self.case(late | {"verdict": "misses"}, outcome))], ["slowest answer"])

    def test_a_case_that_misses_shows_what_misses_and_why(self):
        case = self.case(self.measure("near", 9.0, 10.0, "holds"), self.measure("short", 5.0, 10.0, "misses", ">="), verdict="misses")
        line = markdown.of_hard_cases({"cases": [case]}).splitlines()[4]
        self.assertEqual(line, "| D0 a \\| case | c | short: 5 % (>= 10; hull 2) | misses | because |")


if __name__ == "__main__":
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    unittest.main(verbosity=2)
