# SPDX-License-Identifier: GPL-3.0-or-later
"""Long work: progress, cancelling, Ctrl-C, threads. This needs the builder."""
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import cairn
from conftest import ball

LONG = {"depth": 5, "samples": 200_000}  # minutes


@pytest.fixture(scope="module")
def mesh():
    return cairn.TriangleMesh(*ball(24))


@pytest.fixture(scope="module")
def quick_mesh():
    return cairn.TriangleMesh(*ball(8))


class Stop(Exception):
    pass


def test_progress_rises_to_one_on_the_calling_thread(quick_mesh):
    told, threads = [], set()

    def listen(stage, fraction):
        told.append((stage, fraction))
        threads.add(threading.get_ident())

    cairn.build(quick_mesh, depth=2, samples=2000, progress=listen)
    assert told and threads == {threading.get_ident()}
    assert all(isinstance(stage, str) and stage and 0 <= fraction <= 1 for stage, fraction in told)


@pytest.mark.parametrize("work", [lambda m, p: cairn.build(m, progress=p, **LONG),
                                  lambda m, p: cairn.cover(m, 256, progress=p)])
def test_an_exception_in_the_callback_cancels_and_goes_on(mesh, work):
    calls = []

    def stop(stage, fraction):
        calls.append(time.monotonic())
        raise Stop(stage)

    with pytest.raises(Stop):
        work(mesh, stop)
    assert len(calls) == 1 and time.monotonic() - calls[0] < 1


def test_what_is_no_callable_raises_type_error_and_leaves_no_work(mesh):
    start = time.monotonic()
    with pytest.raises(TypeError):
        cairn.build(mesh, progress=3, **LONG)
    assert time.monotonic() - start < 3


def test_other_threads_run_meanwhile(mesh):
    counted = []

    def count():
        while not ended.is_set():
            counted.append(1)
            time.sleep(0.001)

    ended = threading.Event()
    other = threading.Thread(target=count)
    other.start()
    before = len(counted)
    cairn.build(mesh, depth=2, samples=5000)
    during = len(counted) - before
    ended.set()
    other.join()
    assert during > 20


def test_two_threads_build_at_once_the_same_trees_as_one_alone(quick_mesh):
    alone = [cairn.build(quick_mesh, depth=2, samples=1000, seed=seed).to_bytes() for seed in (1, 2)]
    together = [None, None]

    def build(index):
        together[index] = cairn.build(quick_mesh, depth=2, samples=1000, seed=index + 1).to_bytes()

    threads = [threading.Thread(target=build, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone


def test_one_thread_fails_while_another_succeeds(quick_mesh):
    outcomes = {}

    def build(name, **options):
        try:
            outcomes[name] = cairn.build(quick_mesh, samples=500, **options)
        except Exception as error:
            outcomes[name] = error

    def stop(stage, fraction):
        raise Stop

    threads = [threading.Thread(target=build, args=("good",), kwargs={"depth": 2}),
               threading.Thread(target=build, args=("bad",), kwargs={"depth": 99}),
               threading.Thread(target=build, args=("stopped",), kwargs={"depth": 5, "progress": stop})]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert isinstance(outcomes["good"], cairn.SphereTree)
    assert isinstance(outcomes["bad"], cairn.Error) and isinstance(outcomes["stopped"], Stop)


@pytest.mark.parametrize("work", ["cairn.build(mesh, depth=6, samples=200000)", "cairn.cover(mesh, 512)",
                                  "cairn.evaluate(mesh, cairn.build(mesh, depth=4))"])
def test_ctrl_c_raises_keyboard_interrupt_within_a_second(work):
    program = f"""
import sys, time
sys.path.insert(0, {os.path.dirname(__file__)!r})
import cairn
from conftest import ball
mesh = cairn.TriangleMesh(*ball(40))
print("started", flush=True)
try:
    {work}
except KeyboardInterrupt:
    print("interrupted", time.time(), flush=True)
else:
    print("ended by itself", flush=True)
"""
    process = subprocess.Popen([sys.executable, "-W", "error", "-c", program], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "started\n", process.stderr.read()
    time.sleep(0.7)
    sent = time.time()
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=300)
    assert output.startswith("interrupted"), output + errors
    assert float(output.split()[1]) - sent < 1
    assert process.returncode == 0 and errors == ""


def test_a_fork_of_the_process_ends_while_a_thread_works(mesh):
    program = f"""
import os, sys, threading
sys.path.insert(0, {os.path.dirname(__file__)!r})
import cairn
from conftest import ball
mesh = cairn.TriangleMesh(*ball(16))
def work():
    cairn.build(mesh, depth=3, samples=3000)
other = threading.Thread(target=work)
other.start()
child = os.fork()
if child == 0:
    sys.exit(3)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
other.join()
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert done.stdout == "3\n" and done.returncode == 0, done.stderr
