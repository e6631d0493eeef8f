#!/usr/bin/env python3
"""Each rule of tools/check_documents.py: a good sample passes, a bad one fails with the line that names it."""

import contextlib
import io
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import check_documents
from documents.measures import measure, sentences_of, words_in
from documents.page import read_page, slug_of
from documents.retired import comment_lines

GOOD = {
    "README.md": "# House\n\nThis page is for everyone. It links to [one page](docs/one.md#the-second-part).\n",
    "docs/one.md": "# One\n\nIt is short.\n\n## The second part\n\nIt ends. [Home](../README.md)\n\n![A picture](images/a.png)\n",
    "docs/images/a.png": "not looked into",
}


def prose(words, word="word"):
    """Sentences of ten words each, `words` in all."""
    return " ".join((" ".join([word.capitalize()] + [word] * 9) + ".") for _ in range(words // 10))


class Tree(unittest.TestCase):
    def strict(self, changes=None, *pages):
        """Exit code and lines of breaches of the good tree with `changes` (None: the file is left out)."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in {**GOOD, **(changes or {})}.items():
                if text is None:
                    continue
                path = pathlib.Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            shown, lines = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(shown), contextlib.redirect_stderr(lines):
                try:
                    code = check_documents.main(["--root", folder, "--strict", *pages])
                except SystemExit as end:
                    code = 1 if isinstance(end.code, str) else end.code
                    lines.write(str(end.code))
        return code, lines.getvalue()

    def assert_breach(self, expected, changes):
        code, lines = self.strict(changes)
        self.assertEqual(code, 1, lines)
        self.assertEqual(len(lines.splitlines()), 1, lines)
        self.assertIn(expected, lines)

    def test_good_tree_passes(self):
        self.assertEqual(self.strict(), (0, ""))

    def test_page_over_its_limit(self):
        self.assert_breach("docs/one.md: 1510 words, at most 1500", {"docs/one.md": GOOD["docs/one.md"] + "\n" + prose(1500)})

    def test_limits_by_page(self):
        for name, limit in {"README.md": 500, "docs/algorithms/grid.md": 600, "docs/algorithms/contacts.md": 1500, "docs/results.md": None,
                            "docs/architecture.md": 1200, "docs/file-format.md": 700, "docs/claims.md": 1200, "docs/games.md": 1500}.items():
            self.assertEqual(check_documents.limit_of(name), limit, name)

    def test_pages_without_a_limit_are_left_out_of_the_total(self):
        results = "# Results\n\n" + prose(30000) + " [Home](../README.md)\n"
        self.assertEqual(self.strict({"docs/results.md": results, "docs/one.md": GOOD["docs/one.md"] + "[r](results.md)\n"})[0], 0)

    def test_total_over_its_limit(self):
        pages = {f"docs/p{i}.md": f"# P\n\n[next](p{(i + 1) % 18}.md)\n\n{prose(1490)}\n" for i in range(18)}
        self.assert_breach("all documents: 2", {**pages, "docs/one.md": GOOD["docs/one.md"] + "[p](p0.md)\n"})

    def test_long_sentence(self):
        good = "Word " + "word " * 23 + "end."
        self.assertEqual(self.strict({"docs/one.md": GOOD["docs/one.md"] + "\n" + good + "\n"})[0], 0)
        self.assert_breach("docs/one.md:11: a sentence of 26 words", {"docs/one.md": GOOD["docs/one.md"] + "\nAnd " + good + "\n"})

    def test_mean_of_sentences(self):
        long = " ".join("Word " + "word " * 18 + "end." for _ in range(30))
        self.assert_breach("words a sentence on average", {"docs/one.md": GOOD["docs/one.md"] + "\n" + long + "\n"})

    def test_numbers_in_prose(self):
        numbers = "\n" + " ".join("Word word word word 3 word word word word word." for _ in range(10)) + "\n"
        self.assert_breach("numbers per hundred words", {"docs/one.md": GOOD["docs/one.md"] + numbers})
        table = "\n| a | b |\n| --- | --: |\n" + "| word | 3.5 |\n" * 30 + "\n" + prose(60) + "\n"
        self.assertEqual(self.strict({"docs/one.md": GOOD["docs/one.md"] + table})[0], 0)

    def test_release_over_its_lines(self):
        linked = {"README.md": GOOD["README.md"] + "\n[Changes](CHANGELOG.md)\n"}
        self.assertEqual(self.strict({**linked, "CHANGELOG.md": "# Changes\n\n## 1.0\n" + "- Line.\n" * 99 + "## 0.9\n- Line.\n"})[0], 0)
        self.assert_breach("CHANGELOG.md:3: 101 lines about 1.0",
                           {**linked, "CHANGELOG.md": "# Changes\n\n## 1.0\n" + "- Line.\n" * 100 + "## 0.9\n"})

    def test_broken_links(self):
        for link, expected in {"[x](two.md)": "there is no docs/two.md", "[x](one.md#nowhere)": "anchor 'nowhere'",
                               "[x](#nowhere)": "anchor 'nowhere'", "[x](../../x.md)": "leaves the tree", "[x](/docs/one.md)": "leaves the tree",
                               "![x](images/b.png)": "image 'images/b.png' leads nowhere", "<img src=\"images/b.png\">": "there is no",
                               "[x][ref]\n\n[ref]: two.md": "there is no docs/two.md", "| a |\n| --- |\n| [x](two.md) |": "there is no"}.items():
            with self.subTest(link):
                self.assert_breach(expected, {"docs/one.md": GOOD["docs/one.md"] + "\n" + link + "\n"})

    def test_links_that_are_none(self):
        for text in ("`[x](two.md)`", "```\n[x](two.md)\n```", "<!-- [x](two.md) -->", "[x](https://example.org/two.md)",
                     "- item\n\n  ```cpp\n  a[x](two.md);\n  ```"):
            with self.subTest(text):
                self.assertEqual(self.strict({"docs/one.md": GOOD["docs/one.md"] + "\n" + text + "\n"}), (0, ""))

    def test_page_that_nothing_links_to(self):
        self.assert_breach("docs/two.md: no other page links to it", {"docs/two.md": "# Two\n\nAlone. [Itself](two.md)\n"})

    def test_retired_words(self):
        self.assert_breach("'Counterparts' is retired; the glossary says: collider",
                           {"docs/one.md": GOOD["docs/one.md"] + "\nCounterparts meet.\n"})
        self.assert_breach("plugin/a.h:2: 'promised' is retired", {"plugin/a.h": "int promised;\n// work that is promised\n"})
        self.assert_breach("core/a.cpp:1: 'kMostPairs' is retired", {"core/a.cpp": "int a;  // as kMostPairs\n"})
        self.assertEqual(self.strict({"builder/a.h": "// what a header promises\n"})[0], 0)
        linked = {"README.md": GOOD["README.md"] + "\n[Changes](CHANGELOG.md)\n"}
        self.assertEqual(self.strict({**linked, "CHANGELOG.md": "# C\n\n## 1\n- `Counterpart` is `Collider`.\n"})[0], 0)

    def test_one_page_alone(self):
        bad = {"docs/two.md": "# Two\n\nCounterparts. [x](y.md)\n", "docs/one.md": GOOD["docs/one.md"] + "[two](two.md)\n"}
        self.assertEqual(self.strict(bad, "docs/one.md"), (0, ""))
        code, lines = self.strict(bad, "docs/two.md")
        self.assertEqual((code, len(lines.splitlines())), (1, 2), lines)

    def test_command_line(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "README.md").write_text("# House\n\n[x](y.md)\n", encoding="utf-8")
            command = [sys.executable, str(ROOT / "tools/check_documents.py"), "--root", folder]
            table = subprocess.run(command, capture_output=True, text=True)
            strict = subprocess.run([*command, "--strict"], capture_output=True, text=True)
        self.assertEqual((table.returncode, table.stderr), (0, ""))
        self.assertIn("README.md", table.stdout)
        self.assertEqual(strict.returncode, 1)

    def test_unknown_page_and_empty_tree(self):
        self.assertIn("docs/three.md is no page", self.strict(None, "docs/three.md")[1])
        self.assertIn("no documents", self.strict({name: None for name in GOOD})[1])


class Reading(unittest.TestCase):
    def texts(self, text):
        return [block.text for block in read_page(text).paragraphs]

    def test_sentences_end_where_they_end(self):
        for text, count in {"One. Two! Three? \"Four.\" Five": 5, "Shapes, e.g. Boxes, and i.e. Balls.": 1, "See Fig. 3 and Eq. 2.1 of G. Bradshaw.": 1,
                            "It takes 3.5 s. Then it ends.": 2, "Use cairn.h or a.b. Then go (as in C). Go.": 3, "": 0, "— · |": 0}.items():
            self.assertEqual(len(list(sentences_of(text))), count, text)

    def test_words(self):
        self.assertEqual(words_in("a — b · 3.5 % c/d"), 4)

    def test_what_is_no_prose(self):
        page = "# Head line\n\nSetext\n------\n\n| a b | c |\n| --- | --- |\n| d | `e|f` |\n\n```\ncode code\n```\n\n    indented code\n\n<!-- a\nlong comment --> Prose.\n"
        self.assertEqual(self.texts(page), ["Prose."])
        self.assertEqual([cell.text for cell in read_page(page).cells], ["a b", "c", "d", "Code"])
        self.assertEqual([heading.text for heading in read_page(page).headings], ["Head line", "Setext"])
        self.assertEqual(measure(read_page(page)).words, 1 + 3 + 5)

    def test_items_and_quotes_are_prose_of_their_own(self):
        self.assertEqual(self.texts("- one\n  more\n- two\n1. three\n\n   four\n\n> five\n> six\n"), ["one more", "two", "three", "four", "five six"])

    def test_mark_up_goes(self):
        self.assertEqual(self.texts("**Bold** and *thin* [link\nover](a_b.md \"t\") ![alt](c.png) `a b` snake_case."),
                         ["Bold and thin link over Code snake_case."])

    def test_fences_nest_and_lines_are_kept(self):
        page = read_page("````\n```\n[a](b)\n````\n\nText\n[c](d)\n")
        self.assertEqual([(link.line, link.target) for link in page.links], [(7, "d")])

    def test_numbers(self):
        def numbers(text):
            return measure(read_page(text)).numbers
        self.assertEqual(numbers("8.9 % of 1,500 at 1/60 s, -3 and 1e-4, 10^-6."), 6)
        self.assertEqual(numbers("D16 of Bullet3 in 2D, `1 2 3`, v1.2."), 0)

    def test_anchors(self):
        self.assertEqual(slug_of("What D16 misses, and why?"), "what-d16-misses-and-why")
        self.assertEqual(read_page("## `cairn` & [Time](x.md) *now*\n").anchors, {"cairn--time-now"})
        self.assertEqual(read_page("<a id=\"here\"></a>\n").anchors, {"here"})

    def test_comments_of_code(self):
        self.assertEqual(list(comment_lines("a.cpp", "int a;  // one\n/// two\nauto u = \"http://x\";\n")), [(1, " one"), (2, "/ two")])
        self.assertEqual(list(comment_lines("a.sh", "#!/bin/sh\necho a  # one\n")), [(1, "!/bin/sh"), (2, " one")])


if __name__ == "__main__":
    unittest.main()
