# SPDX-License-Identifier: Zlib
"""Runs the tests of a GoogleTest program, some at a time, so that a crash costs one test and not all that follow."""
import concurrent.futures
import os
import re
import subprocess
import threading

AT_ONCE = 25  # tests per process: their names must fit on a command line, and an emulator's start should not count
SECONDS_PER_TEST = 900  # without a line of output: the test is stopped
RESULT = re.compile(r"^\[ +(OK|FAILED|SKIPPED) +\] ([\w/]+\.[\w/]+)")
BEGUN = re.compile(r"^\[ RUN +\] ([\w/]+\.[\w/]+)")


class Failure(Exception):
    """One sentence for the user."""


def environment(platform):
    return {**os.environ, **dict(platform.environment)}


def listed(command, platform):
    done = subprocess.run([*command, "--gtest_list_tests"], capture_output=True, text=True, env=environment(platform),
                          timeout=SECONDS_PER_TEST)
    names, suite = [], ""
    for line in done.stdout.splitlines():
        text = line.split("#")[0].strip()
        if line[:1] != " " and text.endswith("."):
            suite = text
        elif line.startswith("  "):
            names.append(suite + text)
    if done.returncode != 0 or not names:
        raise Failure(f"{command[-1]} lists no tests: {done.stderr.strip()[:200] or 'it said nothing'}")
    return names


def run_chunk(command, platform, tests):
    """The results of these tests by name: ok, failed or skipped; and what the failing ones printed."""
    process = subprocess.Popen([*command, "--gtest_filter=" + ":".join(tests)], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace", env=environment(platform))
    results, said, current, text = {}, {}, None, []
    watch = None

    def rearm():
        nonlocal watch
        if watch:
            watch.cancel()
        watch = threading.Timer(SECONDS_PER_TEST, process.kill)
        watch.start()

    rearm()
    for line in process.stdout:
        rearm()
        if begun := BEGUN.match(line):
            current, text = begun[1], []
        elif (ended := RESULT.match(line)) and ended[2] == current:
            results[current] = ended[1].lower()
            if ended[1] == "FAILED":
                said[current] = "".join(text)
            current = None
        else:
            text.append(line)
    watch.cancel()
    process.wait()
    if current:
        results[current] = "failed"
        said[current] = "".join(text) + f"the program ended with {process.returncode} during this test"
    return results, said


def run_all_of_chunk(command, platform, tests):
    results, said = {}, {}
    left = list(tests)
    while left:
        more, texts = run_chunk(command, platform, left)
        if not more:  # it does not even begin
            more = {left[0]: "failed"}
            texts = {left[0]: "the program ended before this test began"}
        results.update(more)
        said.update(texts)
        left = [test for test in left if test not in results]
    return results, said


def run_tests(command, platform, progress, only=None):
    """All tests of a program but those left out on the platform: (results, texts of failures, number left out)."""
    names = listed(command, platform)
    if only:
        names = [n for n in names if re.search(only, n)]
    wanted = [n for n in names if not platform.leaves_out(n)]
    chunks = [wanted[i:i + AT_ONCE] for i in range(0, len(wanted), AT_ONCE)]
    results, said = {}, {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pending = [pool.submit(run_all_of_chunk, command, platform, chunk) for chunk in chunks]
        for future in concurrent.futures.as_completed(pending):
            more, texts = future.result()
            results.update(more)
            said.update(texts)
            progress(len(results), len(wanted))
    return results, said, len(names) - len(wanted)
