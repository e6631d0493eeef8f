# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays into meshes: this needs the builder."""
import copy
import gc

import numpy as np
import pytest

import cairn
from conftest import ball, cube, resident_bytes, write_obj


def misaligned(array):
    """The same numbers at an odd address."""
    memory = np.empty(array.nbytes + 1, np.uint8)[1:]
    moved = np.ndarray(array.shape, array.dtype, memory.data)
    moved[...] = array
    return moved


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


LAYOUTS = {
    "as it is": lambda a: a,
    "Fortran": np.asfortranarray,
    "every other row": lambda a: np.repeat(a, 2, axis=0)[::2],
    "backwards": lambda a: a[::-1].copy()[::-1],
    "columns of a wider table": lambda a: np.concatenate([a, a], axis=1)[:, :3],
    "read-only": read_only,
    "misaligned": misaligned,
    "a field of records": lambda a: np.rec.fromarrays([a.T[0], a], dtype=[("x", "u1"), ("p", a.dtype, 3)]).p,
}


@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("floats", [np.float64, np.float32])
@pytest.mark.parametrize("whole", [np.int32, np.int64, np.uint32, np.uint64])
def test_every_layout_and_type_gives_the_same_mesh(layout, floats, whole):
    vertices, triangles = cube()
    given_vertices, given_triangles = LAYOUTS[layout](vertices.astype(floats)), LAYOUTS[layout](triangles.astype(whole))
    mesh = cairn.TriangleMesh(given_vertices, given_triangles, name="cube")
    assert (mesh.vertices == vertices).all() and (mesh.triangles == triangles).all()
    assert (mesh.vertices.dtype, mesh.triangles.dtype) == (np.float64, np.uint32)
    assert mesh.volume == pytest.approx(1) and mesh.bounds == ((0, 0, 0), (1, 1, 1)) and mesh.name == "cube"
    assert mesh.diagonal == pytest.approx(3**0.5) and mesh.changes == "" and mesh.sha256 == ""


def spoiled(index, value, which=0):
    arrays = [a.copy() for a in cube()]
    if value is not None and not np.can_cast(np.array(value).dtype, arrays[which].dtype):
        arrays[which] = arrays[which].astype(np.array(value).dtype)
    arrays[which][index] = value
    return arrays


V, T = cube()
REFUSED = {
    "NaN": (*spoiled((2, 1), np.nan), r"vertices\[2\] is \(0, nan, 0\)"),
    "infinite": (*spoiled((2, 1), -np.inf), r"vertices\[2\].*not finite"),
    "index too large": (*spoiled((3, 0), 8, 1), r"triangles\[3\] names vertex 8, and vertices has 8 rows"),
    "index negative": (*spoiled((3, 2), -1, 1), r"triangles\[3\] names vertex -1"),
    "index beyond 32 bits": (*spoiled((3, 2), 2**32 + 1, 1), r"triangles\[3\] names vertex 4294967297"),
    "index beyond 63 bits": (V, np.where(T == 7, np.uint64(2**64 - 1), T.astype(np.uint64)), "18446744073709551615"),
    "no vertices": (V[:0], T, "vertices is empty"),
    "no triangles": (V, T[:0], "triangles is empty"),
    "flat list": (V.ravel(), T, r"vertices must have the shape \(n, 3\), not \(24,\)"),
    "two columns": (V[:, :2], T, r"vertices must have the shape \(n, 3\), not \(8, 2\)"),
    "three dimensions": (V[None], T, r"not \(1, 8, 3\)"),
    "no dimension": (np.float64(3), T, "vertices must be a NumPy array"),
    "quads": (V, np.zeros((6, 4), int), r"triangles must have the shape \(n, 3\), not \(6, 4\)"),
    "vertices of whole numbers": (V.astype(int), T, "vertices must hold float64 or float32, not int64"),
    "vertices of half precision": (V.astype(np.float16), T, "not float16"),
    "vertices of long doubles": (V.astype(np.longdouble), T, "not float128"),
    "complex": (V.astype(complex), T, "not complex128"),
    "triangles of floats": (V, T.astype(float), "triangles must hold whole numbers of 32 or 64 bits, not float64"),
    "triangles of bytes": (V, T.astype(np.uint8), "not uint8"),
    "triangles of truths": (V, T > 2, "not bool"),
    "objects": (V.astype(object), T, "not object"),
    "text": (V.astype(str), T, "vertices must hold float64"),
    "other byte order": (V.astype(V.dtype.newbyteorder()), T, "byte order"),
    "masked": (np.ma.masked_array(V, V > 0), T, "masked"),
    "a list": (V.tolist(), T, "vertices must be a NumPy array of shape .*, not list; numpy.asarray"),
    "nothing": (None, T, "not NoneType"),
    "open": (V, T[:-1], "the mesh is open"),
    "inside out": (V, T[:, ::-1], "inside out"),
    "without area": (V, np.concatenate([T, [[0, 0, 1]]]), "has no area"),
    "twice": (V, np.concatenate([T, T]), "belongs to 4 triangles"),
    "too small": (V * 1e-20, T, "another unit"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_other_input_is_refused_in_a_sentence(case):
    vertices, triangles, sentence = REFUSED[case]
    with pytest.raises(cairn.Error, match=sentence) as caught:
        cairn.TriangleMesh(vertices, triangles)
    assert "\n" not in str(caught.value)


def test_later_writes_to_the_arrays_do_not_reach_the_mesh():
    vertices, triangles = cube()
    mesh = cairn.TriangleMesh(vertices, triangles)
    vertices[:] = np.nan
    triangles[:] = 1 << 40
    assert mesh.volume == pytest.approx(1) and mesh.triangles.max() == 7


def test_views_outlive_the_mesh_and_copies_are_the_mesh():
    mesh = cairn.TriangleMesh(*cube())
    assert copy.copy(mesh) is mesh and copy.deepcopy(mesh) is mesh
    view = mesh.vertices
    assert view.base is mesh and not view.flags.writeable and view.flags.c_contiguous
    del mesh
    gc.collect()
    assert (view == cube()[0]).all()


def test_what_a_tree_shows_makes_a_mesh_again(rock_tree):
    mesh = cairn.TriangleMesh(rock_tree.vertices, rock_tree.triangles)
    assert mesh.volume == pytest.approx(rock_tree.volume, rel=1e-5)


def test_a_million_triangles_take_one_copy_in_and_none_out(capfd):
    vertices, triangles = ball(502)
    assert len(triangles) > 1_000_000
    needed = 24 * len(vertices) + 12 * len(triangles)
    for floats, whole in ((np.float64, np.int32), (np.float32, np.int64)):
        given = np.asfortranarray(vertices.astype(floats)), triangles.astype(whole)
        gc.collect()
        before = resident_bytes()
        mesh = cairn.TriangleMesh(*given)
        after = resident_bytes()
        views = [mesh.vertices for _ in range(100)] + [mesh.triangles for _ in range(100)]
        viewed = resident_bytes()
        with capfd.disabled():
            print(f"\n{len(triangles)} triangles of {floats.__name__} and {whole.__name__}: arrays "
                  f"{sum(a.nbytes for a in given) / 2**20:.1f} MiB; resident before {before / 2**20:.1f}, with the mesh "
                  f"{after / 2**20:.1f} (its own numbers are {needed / 2**20:.1f}), with 200 views {viewed / 2**20:.1f}")
        assert after - before < 1.3 * needed + 16 * 2**20 and viewed - after < 2**20
        assert views[0].shape == vertices.shape
        del mesh, views


def test_files_are_read_with_the_sentences_of_the_command_line(tmp_path, command):
    write_obj(tmp_path / "cube.obj", *cube())
    mesh = cairn.load_mesh(tmp_path / "cube.obj")
    assert mesh.name == "cube.obj" and len(mesh.sha256) == 64 and mesh.volume == pytest.approx(1)
    write_obj(tmp_path / "open.obj", V, T[:-1])
    (tmp_path / "bad.obj").write_text("v 0 0 nan\nf 1 1 1\n")
    for name in ("nowhere.obj", "bad.obj", "open.obj"):
        with pytest.raises(cairn.Error) as caught:
            cairn.load_mesh(tmp_path / name)
        said = command("build", tmp_path / name, "-o", tmp_path / "x.cairn").stderr
        same = str(caught.value).replace("repair=True or wrap=True", "--repair or --wrap")
        assert f"cairn: {same}\n" == said


def test_open_meshes_are_repaired_or_wrapped(tmp_path):
    write_obj(tmp_path / "open.obj", V, T[:-1])
    repaired = cairn.load_mesh(tmp_path / "open.obj", repair=True)
    assert repaired.volume == pytest.approx(1) and "1 hole" in repaired.changes
    wrapped = cairn.load_mesh(tmp_path / "open.obj", wrap=True, wrap_alpha=0.9)
    assert wrapped.volume > 1 and "nowhere farther than" in wrapped.changes
    near = cairn.load_mesh(tmp_path / "open.obj", wrap=True, wrap_alpha=0.9, wrap_error=0.05)
    assert near.volume < wrapped.volume
    assert float(near.changes.split("farther than ")[1].split()[0]) <= 0.05 * 3**0.5
    with pytest.raises(cairn.Error, match="exclude each other"):
        cairn.load_mesh(tmp_path / "open.obj", wrap=True, repair=True)
    with pytest.raises(cairn.Error):
        cairn.load_mesh(tmp_path / "open.obj", wrap=True, wrap_alpha=float("nan"))


def test_gaps_are_welded_as_wide_as_asked(tmp_path):
    """A cube whose last two triangles are a lid of their own, a thousandth of the edge above it."""
    lid = [[v[0], v[1], v[2]] for v in V] + [[V[i][0], V[i][1], V[i][2]] for t in T[-2:] for i in t]
    normal_axis = next(k for k in range(3) if len({V[i][k] for t in T[-2:] for i in t}) == 1)
    side = V[T[-1][0]][normal_axis]
    for vertex in lid[len(V):]:
        vertex[normal_axis] += 0.001 if side > min(v[normal_axis] for v in V) else -0.001
    faces = [list(t) for t in T[:-2]] + [[len(V), len(V) + 1, len(V) + 2], [len(V) + 3, len(V) + 4, len(V) + 5]]
    write_obj(tmp_path / "lid.obj", np.array(lid), np.array(faces))
    welded = cairn.load_mesh(tmp_path / "lid.obj", repair=True, weld=0.002)
    assert "joined" in welded.changes and welded.volume == pytest.approx(1, abs=0.002)
    try:
        assert "joined" not in cairn.load_mesh(tmp_path / "lid.obj", repair=True).changes, "wider than the usual weld"
    except cairn.Error:
        pass
    for weld in (-0.1, 0.5, float("nan")):
        with pytest.raises(cairn.Error, match="weld is"):
            cairn.load_mesh(tmp_path / "lid.obj", repair=True, weld=weld)
