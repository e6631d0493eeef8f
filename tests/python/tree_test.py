# SPDX-License-Identifier: Zlib
"""Reading trees, which needs no builder."""
import copy
import gc
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import cairn
from conftest import DATA

VIEWS = ("centers", "radii", "errors", "inner_radii", "parents", "vertices", "triangles")


def test_arrays_are_those_of_the_file(rock_tree):
    n = len(rock_tree)
    assert {name: getattr(rock_tree, name).shape for name in VIEWS[:5]} == {
        "centers": (n, 3), "radii": (n,), "errors": (n,), "inner_radii": (n,), "parents": (n,)}
    assert [getattr(rock_tree, name).dtype.name for name in VIEWS] == [
        "float32", "float32", "float32", "float32", "uint32", "float32", "uint32"]
    assert rock_tree.triangles.max() == len(rock_tree.vertices) - 1
    assert np.isfinite(rock_tree.centers).all() and (rock_tree.radii > 0).all() and (rock_tree.errors >= 0).all()
    assert rock_tree.info["branching"] >= 2 and rock_tree.info["mesh"]


def test_levels_and_children_agree(rock_tree):
    assert rock_tree.level_nodes(0) == slice(0, 1, 1)
    ends = [rock_tree.level_nodes(level) for level in range(rock_tree.depth + 1)]
    assert [s.start for s in ends[1:]] == [s.stop for s in ends[:-1]]
    assert ends[-1].stop == len(rock_tree) and rock_tree.level_nodes(-1) == ends[-1]
    seen, leaves = [0], 0
    for node in range(len(rock_tree)):
        children = rock_tree.children(node)
        leaves += children.start == children.stop
        assert (rock_tree.parents[children] == node).all()
        seen.extend(range(children.start, children.stop))
    assert seen == list(range(len(rock_tree))) and leaves == rock_tree.leaf_count


def test_a_cut_covers_every_vertex(rock_tree):
    for level in range(rock_tree.depth + 1):
        cut = rock_tree.cut(level)
        gaps = np.linalg.norm(rock_tree.vertices[:, None].astype(float) - rock_tree.centers[cut], axis=2)
        assert (gaps <= rock_tree.radii[cut].astype(float)).any(axis=1).all()
        assert rock_tree.level_error(level) == rock_tree.errors[cut].max()


def test_region_triangles_of_the_root_are_all(rock_tree):
    assert set(rock_tree.region_triangles(0)) == set(range(len(rock_tree.triangles)))


@pytest.mark.parametrize("ask", [lambda t: t.level_nodes(99), lambda t: t.level_nodes(-99), lambda t: t.cut(99),
                                 lambda t: t.level_error(99), lambda t: t.children(10**6),
                                 lambda t: t.region_triangles(-10**6)])
def test_numbers_out_of_range_raise_index_error(rock_tree, ask):
    with pytest.raises(IndexError, match="the tree has .* none is number"):
        ask(rock_tree)


@pytest.mark.parametrize("name", VIEWS)
def test_views_share_memory_cannot_be_written_and_outlive_the_tree(name):
    tree = cairn.load(DATA / "rock.cairn")
    view, again = getattr(tree, name), getattr(tree, name)
    assert np.shares_memory(view, again) and view.base is tree
    before = view.copy()
    with pytest.raises(ValueError):
        view[0] = 0
    with pytest.raises(ValueError):
        view.flags.writeable = True
    part = view[1:3]
    del tree, view, again
    gc.collect()
    noise = [np.full(1 << 16, 7, np.uint8) for _ in range(50)]  # would land where freed memory was
    assert (part == before[1:3]).all() and noise


def test_thousand_views_leave_no_reference(rock_tree):
    count = sys.getrefcount(rock_tree)
    views = [rock_tree.centers for _ in range(1000)]
    assert sys.getrefcount(rock_tree) == count + 1000
    del views
    assert sys.getrefcount(rock_tree) == count


def test_bytes_and_files_round_trip(rock_tree, tmp_path):
    original = (DATA / "rock.cairn").read_bytes()
    assert rock_tree.to_bytes() == original
    assert cairn.SphereTree.from_bytes(original) == rock_tree
    rock_tree.save(tmp_path / "again.cairn")
    assert (tmp_path / "again.cairn").read_bytes() == original
    rock_tree.save(str(tmp_path / "Fels \u00e4.cairn"))
    assert cairn.load(os.fsencode(tmp_path / "Fels \u00e4.cairn").decode()) == rock_tree


def test_copies_are_the_tree_itself(rock_tree):
    assert copy.copy(rock_tree) is rock_tree and copy.deepcopy([rock_tree])[0] is rock_tree
    assert hash(rock_tree) == hash(cairn.load(DATA / "rock.cairn")) and rock_tree != 3


@pytest.mark.parametrize("damage", [lambda b: b"", lambda b: b[:100], lambda b: b[:-1], lambda b: b + b"x",
                                    lambda b: bytes([b[0] ^ 1]) + b[1:], lambda b: b[:2000] + b"\xff" + b[2001:]])
def test_damaged_bytes_are_refused(damage):
    original = (DATA / "rock.cairn").read_bytes()
    with pytest.raises(cairn.Error):
        cairn.SphereTree.from_bytes(damage(original))


def test_files_that_cannot_be_read_or_written_are_named(tmp_path):
    with pytest.raises(cairn.Error, match="nowhere.cairn"):
        cairn.load(tmp_path / "nowhere.cairn")
    with pytest.raises(cairn.Error, match="nowhere"):
        cairn.load(DATA / "rock.cairn").save(tmp_path / "nowhere" / "rock.cairn")
    with pytest.raises(TypeError):
        cairn.load(3)
    with pytest.raises(TypeError):
        cairn.SphereTree()


def test_mass_is_plausible(rock_tree):
    inertia = rock_tree.inertia
    assert rock_tree.volume > 0 and (inertia == inertia.T).all() and (np.linalg.eigvalsh(inertia) > 0).all()
    assert np.abs(rock_tree.origin - np.array(rock_tree.center_of_mass)).max() < 1e-3


def test_without_the_builder_trees_are_read_and_the_rest_says_why(tmp_path):
    package = pathlib.Path(cairn.__file__).parent
    (tmp_path / "cairn").mkdir()
    for file in package.iterdir():
        if file.is_file() and not file.name.startswith("_builder"):
            (tmp_path / "cairn" / file.name).symlink_to(file)
    program = f"""
import cairn
assert not cairn.has_builder and "build" not in cairn.__all__
assert len(cairn.load({str(DATA / "rock.cairn")!r})) > 1
for take in (lambda: cairn.TriangleMesh, lambda: exec("from cairn import build")):
    try:
        take()
    except ImportError as error:
        assert "built without" in str(error) and "cairn.load" in str(error), error
    else:
        raise SystemExit("no ImportError")
try:
    cairn.nothing
except AttributeError as error:
    assert "nothing" in str(error)
"""
    environment = dict(os.environ, PYTHONPATH=str(tmp_path))
    subprocess.run([sys.executable, "-W", "error", "-c", program], check=True, env=environment, cwd=tmp_path)
