# SPDX-License-Identifier: GPL-3.0-or-later
"""One report at a time in a folder, and no experiment that outlives its report: both would measure into the same files."""
import contextlib
import ctypes
import fcntl
import signal
import subprocess
import sys
import time

PATIENCE_SECONDS = 3  # for children of a report that was just killed to be gone
PR_SET_PDEATHSIG = 1  # of Linux's sys/prctl.h


@contextlib.contextmanager
def locked(data):
    """The lock of a folder of data as a file, or None where another process holds it. Children that inherit it hold it too,
    so that what a killed report left running keeps others out."""
    with open(data / "lock", "w", encoding="utf-8") as file:
        deadline = time.monotonic() + PATIENCE_SECONDS
        while True:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if time.monotonic() > deadline:
                    yield None
                    return
                time.sleep(0.1)
        yield file


def _die_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def started(command, lock, **how):
    """A child that ends when this process does, however that ends (where the system is Linux), and holds the lock."""
    return subprocess.Popen(command, pass_fds=[lock.fileno()] if lock else [],
                            preexec_fn=_die_with_parent if sys.platform == "linux" else None, **how)
