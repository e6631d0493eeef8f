"""Words that docs/glossary.md has replaced, sought in documents and in comments of the code."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Retired:
    pattern: str
    instead: str
    folders: tuple = ()  # the folders where the word has the retired sense; none: everywhere
    flags: int = re.IGNORECASE


# Only words that cannot be meant otherwise there. "Promise" is plain English elsewhere, so it is sought where budgets are.
RETIRED = (
    Retired(r"\bcounterparts?\b", "collider"),
    Retired(r"\bkept[- ]answers?\b", "contact cache"),
    Retired(r"\bredeem\w*", "release (a reservation)"),
    Retired(r"\bpromis(?:e|es|ed|ing)\b", "reservation, reserve", ("core", "plugin")),
    Retired(r"\b(?:is|are|as) no numbers?\b|\bnumber that is none\b", "NaN, non-finite", ("core", "plugin", "docs", "tests")),
    Retired(r"\bstand-ins?\b", "fallback", ("plugin",)),
    Retired(r"\bstrays?\b", "outlier", ("plugin", "docs")),
    Retired(r"\bk(?:Most|Least)[A-Z]\w*", "kMax..., kMin...", flags=0),
)

SLASHES = re.compile(r"(?<![:\"'])//(.*)$")
HASH = re.compile(r"(?:^|\s)#(?!include|pragma|if|else|endif|define|undef|error)(.*)$")
SLASH_FILES = (".h", ".cpp")
HASH_FILES = (".sh", ".py", ".cmake", "CMakeLists.txt")


def comment_lines(name, text):
    """Line numbers and comments of a source file; strings that hold comment marks are not told apart."""
    if name.endswith(SLASH_FILES):
        mark = SLASHES
    elif name.endswith(HASH_FILES):
        mark = HASH
    else:
        return
    for number, line in enumerate(text.split("\n"), 1):
        found = mark.search(line)
        if found:
            yield number, found.group(1)


def retired_words(name, numbered_lines):
    folder = name.split("/")[0]
    for number, line in numbered_lines:
        for word in RETIRED:
            if word.folders and folder not in word.folders:
                continue
            for found in re.finditer(word.pattern, line, word.flags):
                yield f"{name}:{number}: '{found.group(0)}' is retired; the glossary says: {word.instead}"
