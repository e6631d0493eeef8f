#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The check of a page's figures passes what is the same and names what is not."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.path.insert(0, str(HERE.parents[1] / "demos/report"))
import check  # noqa: E402
import figures  # noqa: E402

PAGE = """| | tree | GImpact |
| --- | --: | --: |
| narrow phase, CPU ms a step: median / 99 % | 3.5 / 17.0 | 59.4 / 91.3 |
| gap, % of size | 0.00 | 0.04 |

Times lie within a factor of 2 on other days.
"""
PRINTED = PAGE.partition("\nTimes")[0]


class Differences(unittest.TestCase):
    def test_the_same_table_has_none(self):
        self.assertEqual(check.differences(PAGE, PRINTED), [])

    def test_times_may_differ_by_the_stated_factor_and_no_more(self):
        self.assertEqual(check.differences(PAGE, PRINTED.replace("3.5", "6.9").replace("91.3", "46.0")), [])
        self.assertIn("7.1 / 17.0", check.differences(PAGE, PRINTED.replace("3.5", "7.1"))[0])
        self.assertIn("1.7 / 17.0", check.differences(PAGE, PRINTED.replace("3.5", "1.7"))[0])

    def test_anything_else_must_be_the_same_text(self):
        self.assertIn("the page says 0.04, the command prints 0.05", check.differences(PAGE, PRINTED.replace("0.04", "0.05"))[0])

    def test_a_time_without_a_stated_factor_is_wrong(self):
        self.assertIn("within a factor of N", check.differences(PRINTED, PRINTED)[0])

    def test_a_cell_that_is_not_printed_is_wrong(self):
        self.assertIn("'gap, % of size', 'GImpact'", "".join(check.differences(PAGE, PRINTED.replace("GImpact", "hull"))))
        self.assertEqual(check.differences(PAGE, "nothing"), ["the command prints no Markdown table"])

    def test_names_of_rows_are_not_taken_for_times(self):
        for name in ("asleep at the end", "items", "gap, % of size: mean", "bodies lost in 10 s"):
            self.assertIsNone(check.TIME.search(name), name)
        for name in ("narrow phase, CPU ms a step", "took (µs)", "build, CPU s"):
            self.assertTrue(check.TIME.search(name), name)


class Page(unittest.TestCase):
    @staticmethod
    def run_on(text):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text(text, encoding="utf-8")
            (Path(folder) / "printed").write_text(PRINTED, encoding="utf-8")
            page.write_text(text.replace("FOLDER", folder), encoding="utf-8")
            return subprocess.run([sys.executable, str(HERE / "check.py"), str(page)], capture_output=True, text=True, check=False)

    def test_runs_the_command_of_each_block(self):
        block = f"<!-- figures: cat FOLDER/printed -->\n{PAGE}<!-- /figures -->\n"
        self.assertEqual(self.run_on(block + block).stdout, "2 tables, 0 differences\n")
        wrong = self.run_on(block + block.replace("0.04", "0.03"))
        self.assertEqual((wrong.returncode, wrong.stdout), (1, "2 tables, 1 differences\n"))

    def test_a_command_that_fails_and_a_page_without_blocks_are_errors(self):
        failed = self.run_on(f"<!-- figures: exit 3 -->\n{PAGE}<!-- /figures -->\n")
        self.assertEqual(failed.returncode, 1)
        self.assertIn("exit 3 ended with 3", failed.stderr)
        self.assertEqual(self.run_on("no table").returncode, 1)


class Tables(unittest.TestCase):
    RUN = {"shape": "tree", "bodies": 100, "bodies_asleep": 7, "narrow_phase_cpu_us": {"median": 3456.0, "p99": 17000.0},
           "penetration_end_fraction": {"mean": 0.0005, "max": 0.0043}, "gap_end_fraction": {"mean": 0.00004, "max": None}}

    def test_are_what_the_check_reads(self):
        cells = check.table_of(figures.table(figures.HEAP, [self.RUN, self.RUN | {"shape": "gimpact", "bodies_asleep": 0}]))
        self.assertEqual(cells["asleep at the end", "GImpact"], "0 of 100")
        self.assertEqual(cells["narrow phase, CPU ms a step: median / 99 %", "sphere-tree"], "3.5 / 17.0")
        self.assertEqual(cells["gap between bodies that carry load, % of size: mean", "sphere-tree"], "0.00")


if __name__ == "__main__":
    unittest.main(verbosity=2)
