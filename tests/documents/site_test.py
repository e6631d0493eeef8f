#!/usr/bin/env python3
"""What the site adds to MkDocs: lists as GitHub reads them, the navigation, and the check of the built pages' links."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/site"))

import check_site
from github_lists import as_python_markdown
from navigation import expand


class Lists(unittest.TestCase):
    def assert_rewritten(self, page, expected):
        self.assertEqual(as_python_markdown(page), expected)
        self.assertEqual(as_python_markdown(expected), expected)

    def test_list_after_a_line_of_text(self):
        self.assert_rewritten("Text:\n- one\n- two\n", "Text:\n\n- one\n- two\n")
        self.assert_rewritten("Text:\n1. one\n2. two\n", "Text:\n\n1. one\n2. two\n")

    def test_text_that_looks_like_an_item(self):
        for page in ("At most\n60. Errors\n", "a\n-b\n", "---\n", "* * *\n", "```\nx\n- y\n```\n", "Text\n    - deep\n"):
            self.assert_rewritten(page, page)

    def test_nested_lists(self):
        self.assert_rewritten("- one\n  - two\n    more\n- three\n", "- one\n    - two\n        more\n- three\n")
        self.assert_rewritten("1. one\n   - two\n", "1. one\n    - two\n")

    def test_paragraphs_and_code_in_items(self):
        self.assert_rewritten("- one\n\n  more\n\n  ```\n    a\n  ```\n\nText\n", "- one\n\n    more\n\n    ```\n      a\n    ```\n\nText\n")

    def test_two_lists_with_text_between(self):
        self.assert_rewritten("- one\n\nText\n- two\n", "- one\n\nText\n\n- two\n")


class Navigation(unittest.TestCase):
    NAV = [{"Start": ["README.md"]}, {"More": ["docs/a.md", {"All": ["docs/x/*"]}]}]

    def test_patterns_take_what_is_named_nowhere_else(self):
        nav, problems = expand(self.NAV, ["README.md", "docs/a.md", "docs/x/c.md", "docs/x/b.md"])
        self.assertEqual(problems, [])
        self.assertEqual(nav, [{"Start": ["README.md"]}, {"More": ["docs/a.md", {"All": ["docs/x/b.md", "docs/x/c.md"]}]}])

    def test_page_without_a_place(self):
        problems = expand(self.NAV, ["README.md", "docs/a.md", "docs/x/b.md", "docs/new.md"])[1]
        self.assertEqual(len(problems), 1)
        self.assertIn("docs/new.md: the page is not in the navigation", problems[0])

    def test_entry_without_a_page(self):
        problems = expand(self.NAV, ["README.md", "docs/x/b.md"])[1]
        self.assertEqual(len(problems), 1)
        self.assertIn("names 'docs/a.md', but there is no such page", problems[0])
        self.assertIn("names 'docs/x/*'", expand(self.NAV, ["README.md", "docs/a.md"])[1][0])


class Site(unittest.TestCase):
    def broken(self, body):
        with tempfile.TemporaryDirectory() as folder:
            site = pathlib.Path(folder).resolve()
            (site / "sub").mkdir()
            (site / "api").mkdir()
            (site / "api/index.html").write_text("<a href='nowhere.html'>Doxygen's own</a>")
            (site / "sub/index.html").write_text("<h1 id='here'>x</h1>")
            (site / "index.html").write_text(body)
            return list(check_site.broken(site))

    def test_links_that_lead_somewhere(self):
        self.assertEqual(self.broken("<a href='sub/#here'>x</a><a href='sub'>x</a><a href='api/index.html'>x</a>"
                                     "<a href='https://example.org/x'>x</a><a id='t' href='#t'>x</a>"), [])

    def test_links_that_lead_nowhere(self):
        for body in ("<a href='x.html'>x</a>", "<img src='x.png'>", "<a href='sub/index.html#there'>x</a>", "<a href='#there'>x</a>",
                     "<a href='api'>x</a><a href='api/x.html'>x</a>"):
            with self.subTest(body):
                self.assertEqual(len(self.broken(body)), 1)

    def test_no_site(self):
        done = subprocess.run([sys.executable, str(ROOT / "tools/site/check_site.py"), "/nowhere"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("give the folder of a built site", done.stderr)


@unittest.skipUnless(shutil.which("doxygen"), "doxygen is not installed")
class Headers(unittest.TestCase):
    """The site's Doxyfile on a header of a few lines."""

    def doxygen(self, body):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "sample.h").write_text(f"/// Room.\nnamespace room {{\n{body}\n}}\n")
            settings = (ROOT / "tools/site/Doxyfile").read_text() + f"\nINPUT = {folder}\nOUTPUT_DIRECTORY = {folder}\nUSE_MDFILE_AS_MAINPAGE =\n"
            done = subprocess.run(["doxygen", "-"], cwd=ROOT, input=settings, capture_output=True, text=True)
        return done.returncode, done.stderr

    def test_documented_symbols_pass(self):
        code, lines = self.doxygen("/// A thing.\nstruct CAIRN_CORE_EXPORT Thing {\n  Thing() = default;\n  Thing(const Thing&) = delete;\n"
                                   "  int a = 0, b = 0;  ///< counts\n  float x[2] = {}, y[2] = {};  ///< lengths, m\n};\n/// Works.\nCAIRN_CORE_EXPORT void work(int count);")
        self.assertEqual((code, lines), (0, ""))

    def test_undocumented_symbols_fail(self):
        for body, name in {"/// A thing.\nstruct Thing {\n  int a = 0;\n};": "Member a", "/// A thing.\nclass Thing {\n public:\n  void go();\n};": "go()",
                           "struct Thing {\n  int a = 0;  ///< counts\n};": "Compound room::Thing", "int free();": "free()"}.items():
            with self.subTest(body):
                code, lines = self.doxygen(body)
                self.assertNotEqual(code, 0)
                self.assertIn(name, lines)


if __name__ == "__main__":
    unittest.main()
