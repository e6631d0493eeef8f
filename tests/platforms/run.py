#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""Builds the library for other platforms, runs their tests there and compares bits; prints one table.

examples:
  ./cairn.sh platforms                        all of them: hours
  ./cairn.sh platforms wasm                   one
  ./cairn.sh platforms wasm arm64 --bits      trees and heap only: minutes
  ./cairn.sh platforms arm64 --rooms core     the tests of core alone
  ./cairn.sh platforms windows --tests 'Ray'  tests whose names match
"""
import argparse
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import programs
from platforms import PLATFORMS

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROCK = ROOT / "tests/data/rock.cairn"
# The tree of a ball that is generated without the builder, as this machine's own build writes it.
GENERATED_SHA256 = "4230e6d9b2c411da57cb4bf1028e4d466b6128e55752530665d81a5971a6d4c9"
ROOMS = ("core", "plugin", "effects", "soft", "c")
COLUMNS = ("platform", "builds", "tests run", "tests passed", "left out", "tree bytes equal", "heap hash equal")


def say(text):
    print(f"  {text}", file=sys.stderr, flush=True)


def build(platform, targets, log):
    """Whether it builds. What the build says goes into the file `log`."""
    environment = programs.environment(platform)
    with log.open("w") as out:
        for step in (["cmake", "--preset", platform.preset],
                     ["cmake", "--build", "--preset", platform.preset, "--target", *targets]):
            if subprocess.run(step, cwd=ROOT, stdout=out, stderr=subprocess.STDOUT, env=environment).returncode != 0:
                return False
    return True


def program(platform, name):
    return [*platform.runner, str(ROOT / "build" / platform.preset / "bin" / (name + platform.suffix))]


def run(platform, *words):
    return subprocess.run([*program(platform, "golden_hash"), *map(str, words)], capture_output=True, text=True,
                          env=programs.environment(platform))


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "no file"


def compare_trees(platform):
    """A tree of the builder, read and written again, and one that is generated there: both as written on this machine."""
    with tempfile.TemporaryDirectory(dir=ROOT / "build" / platform.preset) as folder:
        again, own = pathlib.Path(folder) / "again.cairn", pathlib.Path(folder) / "own.cairn"
        # Relative, because other systems spell whole paths in other ways.
        said = [run(platform, os.path.relpath(ROCK), os.path.relpath(again)), run(platform, os.path.relpath(own))]
        result = {"rewritten_equal": sha256(again) == sha256(ROCK), "generated_sha256": sha256(own),
                  "generated_equal": sha256(own) == GENERATED_SHA256}
    for done in said:
        if done.returncode != 0:
            say(f"{platform.name}: {done.stderr.strip()[-300:]}")
    return result


def run_tests(platform, rooms, only):
    tests = {"run": 0, "passed": 0, "skipped": 0, "left_out": 0, "failed": []}
    for room in rooms:
        def progress(done, of, room=room):
            say(f"{platform.name}: {room}: {done} of {of}")
        results, said, left_out = programs.run_tests(program(platform, f"{room}_tests"), platform, progress, only)
        counts = list(results.values())
        tests["passed"] += counts.count("ok")
        tests["skipped"] += counts.count("skipped")
        tests["run"] += len(counts) - counts.count("skipped")
        tests["left_out"] += left_out
        tests["failed"] += [{"test": f"{room}.{test}", "said": said.get(test, "")[-2000:]}
                            for test, result in sorted(results.items()) if result == "failed"]
    return tests


def measure(platform, options):
    row = {"platform": platform.name, "what": platform.what, "builds": False}
    began = time.monotonic()
    log = ROOT / "build" / f"platforms-{platform.name}.log"
    log.parent.mkdir(exist_ok=True)
    say(f"{platform.name}: building into build/{platform.preset}")
    row["builds"] = build(platform, ["golden_hash", *(() if options.bits else [f"{room}_tests" for room in options.rooms])], log)
    if not row["builds"]:
        say(f"{platform.name}: did not build, see {log.relative_to(ROOT)}")
        return row
    row["trees"] = compare_trees(platform)
    say(f"{platform.name}: the heap")
    heap = run(platform)
    row["heap"] = {"hash": heap.stdout.strip(), "equal": heap.returncode == 0}
    if not options.bits:
        row["tests"] = run_tests(platform, options.rooms, options.tests)
    row["left_out_because"] = {pattern: reason for pattern, reason in platform.left_out}
    row["wall_s"] = round(time.monotonic() - began, 1)
    return row


def cells(row):
    def yes(value):
        return "-" if value is None else "yes" if value else "NO"
    tests, trees, heap = row.get("tests", {}), row.get("trees"), row.get("heap")
    return (row["what"], yes(row["builds"]), tests.get("run", "-"), tests.get("passed", "-"), tests.get("left_out", "-"),
            yes(trees and trees["rewritten_equal"] and trees["generated_equal"]), yes(heap and heap["equal"]))


def is_whole(row):
    tests = row.get("tests", {"run": 0, "passed": 0})
    return row["builds"] and tests["run"] == tests["passed"] and all(cell != "NO" for cell in cells(row))


def print_table(rows):
    print("| " + " | ".join(COLUMNS) + " |\n|" + " --- |" * len(COLUMNS))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in cells(row)) + " |")
    for row in rows:
        for failed in row.get("tests", {}).get("failed", []):
            print(f"\n{row['platform']}: {failed['test']} failed")


def arguments():
    parser = argparse.ArgumentParser(prog="./cairn.sh platforms", description=__doc__.split("\n\nexamples")[0],
                                     epilog="examples" + __doc__.split("\n\nexamples")[1],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(PLATFORMS)} (default: all)")
    parser.add_argument("--bits", action="store_true", help="only build and compare bits, without the tests")
    parser.add_argument("--rooms", nargs="+", choices=ROOMS, default=ROOMS, help="whose tests are built and run (default: all)")
    parser.add_argument("--tests", metavar="PATTERN", help="only tests whose names match this regular expression")
    parser.add_argument("--json", metavar="FILE", help="write everything measured, with what failing tests said")
    parser.add_argument("--packages", action="store_true", help="print the groups of packages that are needed, and end")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in PLATFORMS]
    if unknown:
        parser.error(f"there is no platform {unknown[0]}; there are {', '.join(PLATFORMS)}")
    return options


def main():
    options = arguments()
    chosen = [PLATFORMS[name] for name in options.names or PLATFORMS]
    if options.packages:
        print(*sorted({platform.packages for platform in chosen}))
        return 0
    os.chdir(ROOT)
    rows = []
    for platform in chosen:
        if platform.runner and not shutil.which(platform.runner[0]):
            say(f"{platform.name}: {platform.runner[0]} is not installed; install the packages of the group {platform.packages}")
            rows.append({"platform": platform.name, "what": platform.what, "builds": False})
            continue
        try:
            rows.append(measure(platform, options))
        except programs.Failure as failure:
            sys.exit(f"platforms: {failure}")
    print_table(rows)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(rows, indent=2) + "\n")
    return 0 if all(map(is_whole, rows)) else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
