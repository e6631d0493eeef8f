#!/usr/bin/env python3
"""Measures the documents: words per page, length of sentences, numbers in prose, and what is over its limit.

  tools/check_documents.py             the table
  tools/check_documents.py --strict    the table, then one line per breach, and exit code 1 if there are any: pages and
                                       sentences over their limits, links and images that lead nowhere, pages that no page
                                       links to, retired words in documents and comments
  tools/check_documents.py docs/limits.md docs/claims.md --strict
                                       the same of these pages alone (links are still checked against the whole tree)
"""

import argparse
import fnmatch
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from documents.links import broken_links, orphans
from documents.measures import measure
from documents.page import read_page
from documents.retired import comment_lines, retired_words

# Words at most, by the first pattern that fits. None: no limit, and the page does not count towards the total.
MAX_WORDS = (
    ("README.md", 500),
    ("CHANGELOG.md", None),
    ("LICENSE.md", None),
    ("docs/results.md", None),  # generated
    ("docs/algorithms/contacts.md", 1500),
    ("docs/algorithms/*", 600),
    ("docs/architecture.md", 1200),
    ("docs/claims.md", 1200),
    ("docs/file-format.md", 700),
    ("docs/python.md", 600),
    ("*", 1500),
)
MAX_TOTAL_WORDS = 25000
MAX_SENTENCE_WORDS = 25
MAX_MEAN_SENTENCE_WORDS = 17
MAX_NUMBERS_PER_HUNDRED_WORDS = 4
MIN_WORDS_FOR_RATES = 50  # a page of fewer words of prose has no mean to speak of
MAX_CHANGELOG_LINES_A_RELEASE = 100
ENTRY = "README.md"
CHANGELOG = "CHANGELOG.md"


def limit_of(name):
    return next(limit for pattern, limit in MAX_WORDS if fnmatch.fnmatchcase(name, pattern))


def tracked_files(root):
    """The files of the tree that are not ignored, by git where there is a repository."""
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    if listed.returncode == 0:
        names = listed.stdout.splitlines()
    else:
        names = [str(path.relative_to(root)) for path in root.rglob("*") if path.is_file()]
    return sorted(name for name in set(names) if (root / name).is_file())


def is_page(name):
    return name.endswith(".md") and ("/" not in name or name.startswith("docs/"))


def read(root, name):
    try:
        return (root / name).read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        sys.exit(f"check_documents.py: {name} is not UTF-8 ({error.reason} at byte {error.start}); save it as UTF-8.")


def length_breaches(name, measures):
    limit = limit_of(name)
    if limit is None:
        return
    if measures.words > limit:
        yield f"{name}: {measures.words} words, at most {limit}: cut, or move it to the page of its reader"
    for sentence in measures.sentences:
        if sentence.words > MAX_SENTENCE_WORDS:
            start = " ".join(sentence.text.split()[:8])
            yield f"{name}:{sentence.line}: a sentence of {sentence.words} words, at most {MAX_SENTENCE_WORDS}: \"{start} ...\""
    if measures.prose_words < MIN_WORDS_FOR_RATES:
        return
    if measures.mean_sentence > MAX_MEAN_SENTENCE_WORDS:
        yield f"{name}: {measures.mean_sentence:.1f} words a sentence on average, at most {MAX_MEAN_SENTENCE_WORDS}"
    if measures.numbers_per_hundred > MAX_NUMBERS_PER_HUNDRED_WORDS:
        yield (f"{name}: {measures.numbers_per_hundred:.1f} numbers per hundred words of prose, at most "
               f"{MAX_NUMBERS_PER_HUNDRED_WORDS}: move them into a table")


def changelog_breaches(text):
    release, start = None, 0
    lines = text.rstrip("\n").split("\n")
    for number, line in enumerate(lines + ["## end"], 1):
        if not line.startswith("## "):
            continue
        length = number - start
        if release and length > MAX_CHANGELOG_LINES_A_RELEASE:
            yield f"{CHANGELOG}:{start}: {length} lines about {release}, at most {MAX_CHANGELOG_LINES_A_RELEASE} a release"
        release, start = line[3:].strip(), number


def total_of(all_measures):
    return sum(m.words for name, m in all_measures.items() if limit_of(name) is not None)


def print_table(all_measures):
    print(f"{'page':<42} {'words':>6} {'limit':>6} {'mean':>6} {'longest':>8} {'numbers/100':>12}")
    for name, m in all_measures.items():
        limit = limit_of(name)
        over = "  over" if any(True for _ in length_breaches(name, m)) else ""
        print(f"{name:<42} {m.words:>6} {limit if limit is not None else '-':>6} {m.mean_sentence:>6.1f} "
              f"{m.longest.words:>8} {m.numbers_per_hundred:>12.1f}{over}")
    print(f"{'total (without pages that have no limit)':<42} {total_of(all_measures):>6} {MAX_TOTAL_WORDS:>6}")


def retired_breaches(root, names, pages):
    for name in names:
        if name in pages and name != CHANGELOG:
            yield from retired_words(name, enumerate(pages[name].lines, 1))
        elif name not in pages:
            comments = comment_lines(name, read(root, name)) if name.endswith((".h", ".cpp", ".sh", ".py", ".cmake", ".txt")) else ()
            yield from retired_words(name, comments)


def breaches(root, names, pages, all_measures, chosen):
    for name in chosen:
        yield from length_breaches(name, all_measures[name])
    if CHANGELOG in chosen:
        yield from changelog_breaches("\n".join(pages[CHANGELOG].lines))
    yield from (line for line in broken_links(root, pages) if line.split(":")[0] in chosen)
    yield from (line for line in orphans(pages, ENTRY) if line.split(":")[0] in chosen)
    if set(chosen) != set(pages):
        yield from retired_breaches(root, chosen, pages)
        return
    total = total_of(all_measures)
    if total > MAX_TOTAL_WORDS:
        yield f"all documents: {total} words, at most {MAX_TOTAL_WORDS}"
    yield from retired_breaches(root, names, pages)


def main(words=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", metavar="PAGE", help="look at these pages alone (default: all)")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[1],
                        help="the tree to look at (default: the one this program lies in)")
    parser.add_argument("--strict", action="store_true", help="list every breach and exit with 1 if there are any")
    arguments = parser.parse_args(words)
    root = arguments.root.resolve()
    names = tracked_files(root)
    pages = {name: read_page(read(root, name)) for name in names if is_page(name)}
    if not pages:
        sys.exit(f"check_documents.py: no documents in {root}; give the project's folder with --root.")
    unknown = [name for name in arguments.pages if name not in pages]
    if unknown:
        sys.exit(f"check_documents.py: {unknown[0]} is no page of {root}; name pages as docs/limits.md, from the project's folder.")
    chosen = arguments.pages or sorted(pages)
    all_measures = {name: measure(page) for name, page in pages.items()}
    print_table({name: all_measures[name] for name in chosen})
    found = list(breaches(root, names, pages, all_measures, chosen))
    print(f"{len(found)} breaches" + ("" if arguments.strict or not found else "; --strict lists them"))
    if arguments.strict:
        for line in found:
            print(line, file=sys.stderr)
        return 1 if found else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
