# SPDX-License-Identifier: GPL-3.0-or-later
"""What a report was made on and of: machine, compiler, commit, date."""
import datetime
import os
import platform
import subprocess
from pathlib import Path


def _first_line(command, folder=None):
    """What a command says first; nothing when it cannot be run."""
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return done.stdout.strip().split("\n")[0] if done.returncode == 0 else ""


def _value_in(file, key, separator):
    """The first value of a key in a file of lines."""
    try:
        for line in Path(file).read_text(encoding="utf-8", errors="replace").splitlines():
            name, found, value = line.partition(separator)
            if found and name.strip() == key:
                return value.strip().strip('"')
    except OSError:
        pass
    return ""


def _compiler(build):
    cache = build / "CMakeCache.txt"
    program = _value_in(cache, "CMAKE_CXX_COMPILER:FILEPATH", "=") or _value_in(cache, "CMAKE_CXX_COMPILER:STRING", "=")
    if not program:
        return ""
    kind = _value_in(cache, "CMAKE_BUILD_TYPE:STRING", "=")
    flags = _value_in(cache, f"CMAKE_CXX_FLAGS_{kind.upper()}:STRING", "=")
    return f"{_first_line([program, '--version'])}, {kind} ({flags})"


def _memory_gb():
    kilobytes = _value_in("/proc/meminfo", "MemTotal", ":").split()
    return f"{int(kilobytes[0]) / 1e6:.0f} GB" if kilobytes else ""


def _commit(source):
    commit = _first_line(["git", "rev-parse", "HEAD"], source)
    if not commit:
        return ""
    changed = _first_line(["git", "status", "--porcelain", "--untracked-files=no"], source)
    return commit + (", with changes that are not committed" if changed else "")


def now():
    return datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")


def describe(source, build):
    """Of the checkout that the programs were built from. Label and value, in the order they are shown; what cannot be found out says so."""
    facts = {
        "CPU": _value_in("/proc/cpuinfo", "model name", ":") or platform.processor(),
        "Cores": str(os.cpu_count() or ""),
        "Memory": _memory_gb(),
        "System": ", ".join(t for t in (_value_in("/etc/os-release", "PRETTY_NAME", "="),
                                        f"{platform.system()} {platform.release()}") if t),
        "Compiler": _compiler(build),
        "Commit": _commit(_value_in(build / "CMakeCache.txt", "CMAKE_HOME_DIRECTORY:INTERNAL", "=") or source),
        "Date": now(),
        "Load when it began": "%.1f %.1f %.1f (1, 5, 15 minutes)" % os.getloadavg(),
    }
    return {label: value or "not known" for label, value in facts.items()}
