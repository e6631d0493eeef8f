#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The first screen's figure and sentences, on tables whose findings are known. Ends with 77 where gnuplot is missing."""
import random
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPORT = Path(__file__).resolve().parents[2] / "demos/report"
sys.path.insert(0, str(REPORT))
import glance  # noqa: E402


def row(series, side, error, time, budget="", margin=""):
    return {"model": "bunny", "scene": "heap", "series": series, "side": side, "budget_operations": str(budget), "margin_fraction": str(margin),
            "error_mean_fraction": str(error), "time_us": str(time)}


EXACT, LEAVES = "tree + triangles by budget", "tree of 3 levels by budget"
ROWS = [row(EXACT, "ours", 0.001, 1000), row(EXACT, "ours", 0.004, 400, 32000), row(EXACT, "ours", 0.02, 200, 8000), row(LEAVES, "ours", 0.005, 500),
        row(LEAVES, "ours", 0.03, 100, 1000), row("tree of fewer levels", "ours", 0.0001, 1), row("GImpact at a margin of 0.1 %", "rival", 0.003, 4000, margin=0.001),
        row("GImpact at a margin of 1 %", "rival", 0.02, 9000, margin=0.01), row("FCL", "rival", 0.006, 3000)]


def points(rows=ROWS):
    return glance.points_of(rows, "bunny", "heap")


class Sentences(unittest.TestCase):
    def test_say_what_the_table_says(self):
        self.assertEqual(glance.sentences_of(points(), "bunny", "heap"), [
            "On a bunny one metre long, among bodies of a heap, Cairn's contacts err by 0.1 cm and take 1 ms a frame.",
            "Of all rivals on the same poses GImpact, margin 0.1 % errs least: 0.3 cm in 4 ms.",
            "40 % of the time costs you this: contacts of the meshes with 32,000 operations err by 0.4 cm."])
        self.assertEqual(glance.title_of(points()), "Cairn errs 3 times less than the best other shape, and is 4 times as fast")

    def test_say_so_when_the_rival_wins(self):
        better = ROWS + [row("hull without margin", "rival", 0.0005, 100, margin=0)]
        self.assertEqual(glance.title_of(points(better)), "Cairn errs 2 times more than the best other shape, and is 10 times as slow")
        self.assertIn("convex hull errs least: 0.5 mm in 100 µs.", glance.sentences_of(points(better), "bunny", "heap")[1])

    def test_say_so_when_no_budget_is_cheap(self):
        dear = [r for r in ROWS if r["side"] == "rival"] + [ROWS[0], row(EXACT, "ours", 0.004, 900, 32000)]
        self.assertTrue(glance.sentences_of(points(dear), "bunny", "heap")[2].startswith("No budget here"))

    def test_show_each_rival_at_its_least_error(self):
        self.assertEqual([p.label for p in points() if p.kind == "rival"], ["GImpact, margin 0.1 %", "FCL"])
        self.assertEqual([p.label for p in points() if p.kind != "rival"],
                         ["Cairn, no budget", "Cairn, 32,000 operations", "Cairn, 8,000 operations", "Cairn, contacts of leaves"])


class Tables(unittest.TestCase):
    def test_that_say_too_little_are_refused(self):
        for rows in ([], [r for r in ROWS if r["side"] == "ours"], [r for r in ROWS if r["side"] == "rival"], [*ROWS, row("x", "rival", "", 1)],
                     [*ROWS, row("x", "rival", 0, 1)], [*ROWS, row("x", "rival", "nan", 1)]):
            with self.assertRaises(glance.Unusable):
                points(rows)

    def test_of_something_else_are_refused_in_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "other.csv"
            other.write_text("a,b\n1,2\n", encoding="utf-8")
            done = subprocess.run([sys.executable, str(REPORT / "glance.py"), str(other)], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (1, "", 1), done.stderr)


class Labels(unittest.TestCase):
    def test_stand_clear_of_points_and_each_other(self):
        seed = random.randrange(1 << 30)
        generator, crowded = random.Random(seed), 0
        for _ in range(40):
            some = [glance.Point(f"point {i}", "rival", 10 ** generator.uniform(-1, 1), 10 ** generator.uniform(2, 4)) for i in range(12)]
            frame = glance.Frame(some)
            for p in some:
                frame.place(p, p.label)
            for i, (a, b, c, d) in enumerate(frame.taken[12:]):
                self.assertGreaterEqual(a, glance.LEFT)
                self.assertLessEqual(c, glance.WIDTH - glance.RIGHT)
                crowded += any(min(c, t[2]) > max(a, t[0]) and min(d, t[3]) > max(b, t[1]) for t in frame.taken[12 + i + 1:])
        self.assertLessEqual(crowded, 40 * 12 // 50, f"seed {seed}: {crowded} of {40 * 12} labels overlap others")

    def test_are_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("glance.svg", "glance.png"):
                glance.draw(points(), Path(folder) / name)
                self.assertGreater((Path(folder) / name).stat().st_size, 5000)
            drawn = (Path(folder) / "glance.svg").read_text(encoding="utf-8")
            for p in points():
                self.assertIn(p.label, drawn)


if __name__ == "__main__":
    if not shutil.which("gnuplot"):
        print("gnuplot is not installed")
        sys.exit(77)
    unittest.main()
