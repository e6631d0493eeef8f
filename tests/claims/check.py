#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails when docs/claims.md names a test that does not exist. Reads sources, so it needs no build."""
import re
import subprocess
import sys
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
GTEST = re.compile(r"^(?:TEST(?:_F|_P)?|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\(\s*(\w+),\s*(\w+)", re.MULTILINE)
INSTANTIATED = re.compile(r"INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)")
ADDED = re.compile(r"add_test\(\s*NAME\s+(\S+)")
COMMAND = re.compile(r"`(T|ctest --preset release[^`]*? -R) \"?([^`\"]+)\"?`")


def tests():
    """Names as ctest prints them; a parametrised suite stands with each of its prefixes, without its parameters."""
    names = set()
    for file in (SOURCE / "tests").rglob("*.cpp"):
        program, text = file.relative_to(SOURCE / "tests").parts[0], file.read_text(encoding="utf-8")
        prefixes = {}
        for prefix, suite in INSTANTIATED.findall(text):
            prefixes.setdefault(suite, []).append(f"{prefix}/")
        for suite, case in GTEST.findall(text):
            names |= {f"{program}.{prefix}{suite}.{case}" for prefix in prefixes.get(suite, [""])}
    for file in (SOURCE / "tests").rglob("CMakeLists.txt"):
        names |= set(ADDED.findall(file.read_text(encoding="utf-8")))
    return names


def alternatives(pattern):
    """Each alternative of a pattern alone: all must name a test."""
    group = re.search(r"\(([^()]*)\)", pattern)
    if group:
        return [each for one in group[1].split("|") for each in alternatives(pattern[:group.start()] + one + pattern[group.end():])]
    return pattern.split("|")


def main():
    page = Path(sys.argv[1]) if len(sys.argv) > 1 else SOURCE / "docs/claims.md"
    known = tests()
    commands = COMMAND.findall(page.read_text(encoding="utf-8").replace("\\|", "|"))
    missing = [one for _, pattern in commands for one in alternatives(pattern) if not any(re.search(one, name) for name in known)]
    for one in missing:
        print(f"{page.name}: no test is called '{one}'", file=sys.stderr)
    if not commands:
        print(f"{page.name}: it names no test", file=sys.stderr)
    print(f"{len(commands)} commands, {len(known)} tests, {len(missing)} names without a test")
    return 1 if missing or not commands else 0


if __name__ == "__main__":
    sys.exit(main())
