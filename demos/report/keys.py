# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether what an earlier run left may be kept: keys of all that a part depends on, digests of all that it left."""
import hashlib
import json
import os
from pathlib import Path

_known = {}  # digests of files by path, size and time of change: programs are large and named by many parts


def _digest_of(file):
    status = file.stat()
    key = (str(file), status.st_size, status.st_mtime_ns)
    if key not in _known:
        _known[key] = hashlib.sha256(file.read_bytes()).hexdigest()
    return _known[key]


def content_of(path):
    """Names and digests of a file, or of the files in a folder (not of those below); of what is not there its name alone."""
    path = Path(path)
    try:
        if path.is_dir():
            return [f"{file.name} {_digest_of(file)}" for file in sorted(path.iterdir()) if file.is_file()]
        return [f"{path.name} {_digest_of(path)}"]
    except OSError:
        return [f"{path.name} is not there"]


def key_of(command, files, machine):
    """Of a command with all its options, of the programs, meshes and archives it reads, and of the processor it runs on: times
    are part of what it leaves."""
    lines = [*command, *(line for file in files for line in content_of(file)), machine.get("CPU", ""), machine.get("Cores", "")]
    return hashlib.sha256("\0".join(lines).encode()).hexdigest()


def left_by(part, data):
    """Names of all files a part leaves in the folder of the data: the outputs of all parts, and the figures an experiment's
    JSON names. Of figures none where it cannot be read."""
    names = list(part.outputs)
    if part.kind == "experiment":
        try:
            names += json.loads((data / part.outputs[0]).read_text(encoding="utf-8"))["figures"]
        except (OSError, ValueError, KeyError, TypeError):
            pass
    return names


def digests_of(names, data):
    """By name, for a stamp; a file that is not there has none."""
    found = {}
    for name in names:
        try:
            found[name] = _digest_of(data / name)
        except OSError:
            found[name] = ""
    return found


def written_whole(path, text):
    """To a temporary name, then renamed: a file that is there is all there."""
    partial = Path(f"{path}.partial")
    partial.write_text(text, encoding="utf-8")
    os.replace(partial, path)
