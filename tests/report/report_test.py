#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The report's page, made of tiny real runs: report_test.py PROGRAMS. Ends with 77 where jinja2 is not installed."""
import html.parser
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
REPORT = SOURCE / "demos/report"
PROGRAMS = ""
MEASURED = ["textbook", "expand-selection", "levels"]
sys.path.insert(0, str(REPORT))

VOID = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}


class Page(html.parser.HTMLParser):
    """What a page is made of, and what is wrong with its tags."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.tags, self.ids, self.links, self.sources, self.words = [], [], [], [], [], [], []
        self.feed(text)
        self.close()
        self.faults += [f"{tag} is not closed" for tag in self.open]
        self.text = re.sub(r"\s+", " ", " ".join(self.words))

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        attrs = dict(attrs)
        self.ids += [attrs["id"]] if "id" in attrs else []
        self.links += [attrs["href"]] if "href" in attrs else []
        self.sources += [v for k, v in attrs.items() if k in ("src", "srcset", "data", "poster")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}> at {self.getpos()}")

    def handle_data(self, data):
        if not self.open or self.open[-1] != "style":
            self.words.append(data)


def run(output, *more, programs=None):
    return subprocess.run([sys.executable, str(REPORT / "measure.py"), "--quick", "-o", str(output), "--programs", programs or PROGRAMS, *more],
                          capture_output=True, text=True, check=False, timeout=500)


def squeezed(text):
    return re.sub(r"\s+", " ", text).strip()


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = Path(cls.folder.name)
        cls.meshes, cls.out = root / "meshes", root / "out"
        subprocess.run([f"{PROGRAMS}/accuracy_cost", "models", "cube", "-o", str(cls.meshes)], check=True, stdout=subprocess.DEVNULL)
        cls.done = run(cls.out, "--models", str(cls.meshes), "--only", ",".join(MEASURED))
        cls.data = cls.out / "data-quick"
        cls.html = (cls.out / "index.html").read_text(encoding="utf-8") if (cls.out / "index.html").exists() else ""
        cls.page = Page(cls.html)
        cls.record = json.loads((cls.data / "run.json").read_text(encoding="utf-8"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_is_made(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        states = {p["name"]: p["state"] for p in self.record["parts"]}
        for name in MEASURED:
            self.assertEqual(states[name], "done")

    def test_is_well_formed(self):
        self.assertEqual(self.page.faults, [])
        self.assertEqual(len(self.page.ids), len(set(self.page.ids)), "an id is there twice")
        for tag in ("html", "head", "title", "main", "nav"):
            self.assertEqual(self.page.tags.count(tag), 1, tag)

    def test_is_self_contained(self):
        for tag in ("script", "link", "iframe", "object", "embed", "base"):
            self.assertNotIn(tag, self.page.tags)
        for target in self.page.sources:
            self.assertTrue(target.startswith("data:"), target[:80])
        for target in self.page.links:
            self.assertTrue(target.startswith(("#", "data:")), target[:80])
            if target.startswith("#"):
                self.assertIn(target[1:], self.page.ids)
        style = self.html[self.html.index("<style>"):self.html.index("</style>")]
        self.assertNotIn("@import", style)
        self.assertNotIn("url(", style)

    def test_names_every_experiment(self):
        listed = subprocess.run([f"{PROGRAMS}/accuracy_cost", "list"], capture_output=True, text=True, check=True).stdout
        names = [line.split()[0] for line in listed.splitlines()]
        self.assertGreaterEqual(len(names), 6)
        for name in names:
            self.assertIn(name, self.page.ids)

    def test_names_what_is_missing(self):
        absent = [p for p in self.record["parts"] if p["state"] != "done"]
        self.assertGreater(len(absent), 5)
        missing = self.page.text[self.page.text.rindex("What is missing"):]
        for part in absent:
            self.assertIn(f"{part['name']} ): {part['why']}", missing)

    def test_shows_every_command(self):
        for part in self.record["parts"]:
            self.assertIn(squeezed(part["command"]), self.page.text)
            self.assertTrue(part["command"])

    def test_names_machine_commit_and_date(self):
        for label in ("CPU", "Cores", "Compiler", "System", "Commit", "Date"):
            self.assertIn(self.record["machine"][label], self.page.text)
        self.assertRegex(self.record["machine"]["Date"], r"^20\d\d-\d\d-\d\d")

    def test_says_what_the_experiments_say(self):
        document = json.loads((self.data / "levels.json").read_text(encoding="utf-8"))
        section = self.page.text
        self.assertIn(document["verdict"], section)
        self.assertIn(squeezed(document["thesis_says"]), section)
        for claim in document["claims"]:
            self.assertIn(claim["found"][1:], section)
            self.assertIn(claim["rule"], section)
        self.assertIn("data:image/" if document["figures"] else "no figure was drawn", self.html)

    def test_shows_the_textbook(self):
        line = json.loads((self.data / "textbook.json").read_text(encoding="utf-8"))[4]
        self.assertIn(f"{line['experiment']} {line['quantity']}", self.page.text)
        self.assertIn(f"{100 * line['shapes']['hull']['error_fraction']:.2f}", self.page.text)

    def test_keeps_what_is_there(self):
        stamps = {f.name: f.read_bytes() for f in (self.data / "stamps").iterdir()}
        again = run(self.out, "--models", str(self.meshes), "--only", ",".join(MEASURED))
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertNotIn("left for all", again.stdout)
        self.assertEqual(stamps, {f.name: f.read_bytes() for f in (self.data / "stamps").iterdir()})

        made = {p["name"]: p["made"] for p in self.record["parts"] if p["state"] == "done"}
        kept = json.loads((self.data / "run.json").read_text(encoding="utf-8"))
        self.assertEqual(made, {p["name"]: p["made"] for p in kept["parts"] if p.get("kept")}, "as they were made, not as they were kept")
        page = Page((self.out / "index.html").read_text(encoding="utf-8"))
        self.assertNotIn("Kept from an earlier run", self.page.text)
        self.assertEqual(page.text.count("Kept from an earlier run"), len(MEASURED))
        self.assertIn(f"{len(MEASURED)} of {len(MEASURED)} parts are kept from earlier runs", page.text)
        for part in made.values():
            self.assertIn(f"{part['date']}, commit {part['commit'][:12]}", page.text)
            self.assertIn(squeezed(part["command"]), page.text)

    def test_measures_anew_what_a_folder_of_meshes_changes(self):
        with tempfile.TemporaryDirectory() as folder:
            meshes, only = Path(folder) / "meshes", ("--only", "expand-selection,textbook")
            shutil.copytree(self.meshes, meshes)
            self.assertEqual(run(f"{folder}/out", "--models", str(meshes), *only).returncode, 0)
            table = Path(folder) / "out/data-quick/expand-selection.csv"
            before = table.read_text(encoding="utf-8")
            mesh = (meshes / "cube.obj").read_text(encoding="utf-8")
            longer = re.sub(r"^v (\S+) ", lambda corner: f"v {2 * float(corner[1])} ", mesh, flags=re.MULTILINE)
            self.assertNotEqual(mesh, longer)
            (meshes / "cube.obj").write_text(longer, encoding="utf-8")
            again = run(f"{folder}/out", "--models", str(meshes), *only)
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertIn("expand-selection, about", again.stdout)
            self.assertNotIn("textbook, about", again.stdout, "it has nothing to do with the meshes")
            self.assertNotEqual(table.read_text(encoding="utf-8"), before)
            record = json.loads((Path(folder) / "out/data-quick/run.json").read_text(encoding="utf-8"))
            self.assertEqual({p["name"]: p["kept"] for p in record["parts"] if p["state"] == "done"}, {"textbook": True, "expand-selection": False})

    def test_makes_again_what_is_damaged_or_gone(self):
        with tempfile.TemporaryDirectory() as folder:
            out, options = f"{folder}/out", ("--models", str(self.meshes), "--only", "textbook,expand-selection")
            data = Path(out) / "data-quick"
            self.assertEqual(run(out, *options).returncode, 0)
            table, figures = data / "expand-selection.csv", sorted(data.glob("expand-selection*.[sp]*g"))
            whole, day = table.read_bytes(), json.loads((data / "stamps/expand-selection.json").read_text(encoding="utf-8"))["made"]

            def again(*made):
                done = run(out, *options)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(re.findall(r"^\[\S+ (\S+), about", done.stdout, re.MULTILINE), list(made))
                self.assertEqual(table.read_bytes(), whole)
                return json.loads((data / "stamps/expand-selection.json").read_text(encoding="utf-8"))["made"]

            os.truncate(data / "textbook.json", 100)
            again("textbook")
            for damage in (whole[:-20], bytes(len(whole)), b""):
                table.write_bytes(damage)
                again("expand-selection")
            (data / "expand-selection.json").write_text("{}", encoding="utf-8")
            again("expand-selection")
            for stamp in ("null", "[1]", '{"key": 1, "made": 2, "files": 3, "seconds": "4"}', "", "{"):
                (data / "stamps/textbook.json").write_text(stamp, encoding="utf-8")
                again("textbook")
            day = again()
            for figure in figures:
                drawn = figure.read_bytes()
                figure.unlink()
                self.assertEqual(again("expand-selection"), day, "it is drawn, not measured")
                self.assertEqual(len(figure.read_bytes()), len(drawn))

    def test_says_what_failed_and_ends_with_1(self):
        with tempfile.TemporaryDirectory() as folder:
            meshes = Path(folder) / "meshes"
            meshes.mkdir()
            (meshes / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
            done = run(f"{folder}/out", "--models", str(meshes), "--only", "textbook,levels")
            self.assertEqual(done.returncode, 1)
            self.assertIn("levels", done.stderr)
            page = Page((Path(folder) / "out/index.html").read_text(encoding="utf-8"))
            self.assertEqual(page.faults, [])
            self.assertRegex(page.text, r"Failed: .*levels.*open\.obj")

    def test_shows_hard_cases_and_escapes(self):
        import page
        with tempfile.TemporaryDirectory() as folder:
            cases = [{"id": "H1", "name": "a <b>bold</b> pile", "criterion": "x < 1 & y", "measured": 0.25, "stock": "falls", "verdict": "as good as stock", "why": ""}]
            (Path(folder) / "hard-cases.json").write_text(json.dumps({"cases": cases}), encoding="utf-8")
            part = next(p for p in self.record["parts"] if p["name"] == "hard-cases")
            others = [p | ({"state": "failed", "why": "<script>alert(1)</script>"} if p["state"] == "done" else {}) for p in self.record["parts"] if p is not part]
            record = self.record | {"parts": others + [part | {"state": "done", "seconds": 1}]}
            made = Page(page.render(record, Path(folder)))
            self.assertEqual(made.faults, [])
            self.assertNotIn("b", made.tags)
            self.assertNotIn("script", made.tags)
            for text in ("H1 a <b>bold</b> pile", "x < 1 & y", "0.250", "◐ as good as stock"):
                self.assertIn(text, made.text)

    def test_a_file_that_cannot_be_read_is_named(self):
        import page
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "textbook.json").write_text('[{"experiment": "R1"}]', encoding="utf-8")
            (Path(folder) / "levels.json").write_text("{", encoding="utf-8")
            wanted = [dict(p) for p in self.record["parts"] if p["name"] in ("textbook", "levels")]
            others = [dict(p) | {"state": "absent", "why": "of no matter"} for p in self.record["parts"] if p["name"] not in ("textbook", "levels")]
            (Path(folder) / "run.json").write_text(json.dumps(self.record | {"parts": others + wanted}), encoding="utf-8")
            self.assertEqual(sorted(page.write(folder, f"{folder}/page.html")), ["levels", "textbook"])
            made = Page(Path(f"{folder}/page.html").read_text(encoding="utf-8"))
            self.assertEqual(made.faults, [])
            self.assertEqual(made.text.count("what it left cannot be read"), 4, "in its place and in the list")

    def test_names_models_that_are_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            done = run(f"{folder}/out", "--archive", "/nosuch", "--only", "expand-selection")
            self.assertEqual(done.returncode, 0, done.stderr)
            page = Page((Path(folder) / "out/index.html").read_text(encoding="utf-8"))
            self.assertRegex(page.text, r"Left out: bunny, for which the archive of meshes is not there")

    def test_names_the_sweep_and_advise(self):
        for command in ("build/release/bin/frame_budget --scene heap,", "build/release/bin/cairn advise "):
            self.assertIn(command, self.page.text)

    def test_refuses_in_one_sentence(self):
        unknown = run(self.out, "--only", "no-such")
        self.assertEqual(unknown.returncode, 2)
        self.assertIn("textbook", unknown.stderr, "the parts are listed")
        nowhere = run(self.out, programs=str(self.meshes))
        self.assertEqual(nowhere.returncode, 1)
        self.assertEqual(len(nowhere.stderr.strip().splitlines()), 1)

    def test_is_cancelled_without_a_page(self):
        with tempfile.TemporaryDirectory() as folder:
            command = [sys.executable, str(REPORT / "measure.py"), "-o", f"{folder}/out", "--programs", PROGRAMS, "--models", str(self.meshes), "--only", "reductions"]
            child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 60
            while not list(Path(folder).glob("out/data/logs/reductions.out.partial")) and time.monotonic() < deadline:
                time.sleep(0.05)
            time.sleep(0.5)
            child.send_signal(signal.SIGINT)
            self.assertEqual(child.wait(60), 130)
            left = [f for f in Path(folder).rglob("*") if f.suffix in (".html", ".json", ".csv", ".partial")]
            self.assertEqual(left, [])


def child_of(process):
    """The one child a report has."""
    return int(Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()[0])


@unittest.skipUnless(Path("/proc/self/task").exists(), "children are found in Linux's /proc")
class Alone(unittest.TestCase):
    """One report at a time in a folder, and nothing that outlives it."""

    def test_a_second_is_refused_and_a_killed_one_leaves_no_experiment(self):
        with tempfile.TemporaryDirectory() as folder:
            out = f"{folder}/out"
            command = [sys.executable, str(REPORT / "measure.py"), "--quick", "-o", out, "--programs", PROGRAMS, "--only", "interruption"]
            subprocess.run([f"{PROGRAMS}/accuracy_cost", "models", "torus", "-o", f"{folder}/meshes"], check=True, stdout=subprocess.DEVNULL)
            first = subprocess.Popen([*command, "--models", f"{folder}/meshes"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 60
            while not list(Path(out).glob("data-quick/logs/interruption.out.partial")) and time.monotonic() < deadline:
                time.sleep(0.05)
            time.sleep(0.3)
            experiment = child_of(first)
            second = run(out, "--only", "textbook")
            self.assertEqual(second.returncode, 1)
            self.assertRegex(second.stderr, r"\Areport: another report, .*at work in .*\n\Z")
            first.kill()
            first.wait()
            deadline = time.monotonic() + 10
            while Path(f"/proc/{experiment}/exe").exists() and time.monotonic() < deadline:
                time.sleep(0.05)
            self.assertFalse(Path(f"/proc/{experiment}/exe").exists(), "the experiment goes on")
            third = run(out, "--only", "textbook")
            self.assertEqual(third.returncode, 0, third.stderr)


class Commands(unittest.TestCase):
    """What the page shows can be typed."""

    def test_are_quoted_and_whole(self):
        import parts
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "a b" / "it's"
            source.mkdir(parents=True)
            (source / "bin").symlink_to(PROGRAMS)
            data = source / "out/é"
            plan = parts.Plan(source, source / "bin", data, True, "/my meshes/weird", "/x y.tar.gz").parts()
            shown = {part.name: parts.shown(part, source, data) for part in plan}
        self.assertEqual(shlex.split(shown["model-bunny"]),
                         ["bin/accuracy_cost", "models", "bunny", "-o", "out/é/models", "--archive", "/x y.tar.gz"])
        self.assertEqual(shlex.split(shown["levels"])[-3:], ["--quick", "--models", "/my meshes/weird"])
        self.assertEqual(shlex.split(shown["builder"])[-2:], [">", "out/é/builder.txt"])
        for text in shown.values():
            self.assertNotIn(folder, text)

    def test_the_reports_own_has_all_its_options(self):
        import measure
        asked = ["--quick", "--only", "levels", "-o", "/tmp/a b", "--models", "/tmp/some/weird", "--archive", "/no such", "--programs", "/usr/share"]
        before, sys.argv = sys.argv, ["report", *asked]
        try:
            self.assertEqual(shlex.split(measure.command_of(measure.options(), SOURCE)), ["./cairn.sh", "report", *asked])
            sys.argv = ["report"]
            os.chdir(SOURCE)
            self.assertEqual(measure.command_of(measure.options(), SOURCE), "./cairn.sh report")
        finally:
            sys.argv = before


class TenMinutes(unittest.TestCase):
    """--quick ends in time whatever its parts do."""

    @staticmethod
    def records(folder, seconds, *commands):
        import measure
        import parts
        for name in ("stamps", "logs"):
            (Path(folder) / name).mkdir()
        plan = [parts.Part(f"part{i}", "A part", "textbook", list(command), [], 1) for i, command in enumerate(commands)]
        about = {"CPU": "one", "Cores": "2", "Commit": "abc"}
        measuring = measure.Measuring(Path(folder), SOURCE, time.monotonic() + seconds, about, "report")
        return measuring.all(plan, set())

    def test_a_part_that_is_too_long_is_stopped_and_the_rest_not_begun(self):
        with tempfile.TemporaryDirectory() as folder:
            began = time.monotonic()
            records = self.records(folder, 2, ["true"], ["sleep", "60"], ["true"])
            self.assertLess(time.monotonic() - began, 30)
            self.assertEqual([r["state"] for r in records.values()], ["done", "left out", "left out"])
            self.assertIn("stopped", records["part1"]["why"])
            self.assertIn("goes on from here", records["part2"]["why"])


if __name__ == "__main__":
    try:
        import jinja2  # noqa: F401
    except ImportError:
        print("skipped: jinja2 is not installed (python3-jinja2)")
        sys.exit(77)
    PROGRAMS = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
