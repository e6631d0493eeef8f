# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes and the command line for the tests of the Python package."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

import cairn

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"


def ball(rings, sectors=None, radius=1.0):
    """A closed ball of latitudes and longitudes: (rings - 1) * sectors * 2 triangles."""
    sectors = sectors or 2 * rings
    latitude = np.linspace(0, np.pi, rings + 1)[1:-1, None]
    longitude = np.linspace(0, 2 * np.pi, sectors, endpoint=False)[None, :]
    points = np.stack(np.broadcast_arrays(np.sin(latitude) * np.cos(longitude), np.sin(latitude) * np.sin(longitude),
                                          np.cos(latitude)), axis=-1).reshape(-1, 3)
    vertices = np.concatenate([points, [[0, 0, 1], [0, 0, -1]]]) * radius
    north, south = len(points), len(points) + 1
    here, right = np.arange(sectors), (np.arange(sectors) + 1) % sectors
    upper = np.arange(rings - 2)[:, None] * sectors
    lower = upper + sectors
    sides = np.concatenate([np.stack(np.broadcast_arrays(upper + here, lower + here, lower + right), -1).reshape(-1, 3),
                            np.stack(np.broadcast_arrays(upper + here, lower + right, upper + right), -1).reshape(-1, 3)])
    last = (rings - 2) * sectors
    caps = np.concatenate([np.stack([np.full(sectors, north), here, right], -1),
                           np.stack([np.full(sectors, south), last + right, last + here], -1)])
    return vertices, np.concatenate([sides, caps]).astype(np.int64)


def cube():
    vertices = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return vertices, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def write_obj(path, vertices, triangles):
    path.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices.tolist()) +
                    "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in triangles.tolist()))


def resident_bytes():
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


@pytest.fixture
def rock_tree():
    return cairn.load(DATA / "rock.cairn")


@pytest.fixture
def command():
    """Runs `cairn` with these arguments; returns the finished process."""
    tool = os.environ["CAIRN_TOOL"]

    def run(*arguments):
        return subprocess.run([tool, *map(str, arguments)], capture_output=True, text=True, timeout=300)

    return run
