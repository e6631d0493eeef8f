# SPDX-License-Identifier: GPL-3.0-or-later
"""Trees, covers, proofs and forms, beside the command line: this needs the builder."""
import json

import numpy as np
import pytest

import cairn
from conftest import ball, cube, write_obj

QUICK = {"depth": 2, "samples": 500}


@pytest.fixture(scope="module")
def mesh():
    return cairn.TriangleMesh(*ball(8))


@pytest.fixture(scope="module")
def tree(mesh):
    return cairn.build(mesh, **QUICK)


@pytest.fixture
def file(tmp_path):
    """A mesh as a file, with a lump so that it is nobody's symmetric special case."""
    vertices, triangles = ball(8)
    vertices[vertices[:, 0] > 0.7] *= [1.4, 1, 1]
    write_obj(tmp_path / "lump.obj", vertices, triangles)
    return tmp_path / "lump.obj"


@pytest.mark.parametrize("options", [
    {}, {"method": "octree"}, {"method": "adaptive", "depth": 1}, {"branching": 4, "seed": 2**64 - 1}, {"balance": 0.05},
    {"method": "burst", "optimise": "thesis", "balance": "work"}, {"threads": 1}])
def test_a_tree_has_the_bytes_of_the_command_line(file, tmp_path, command, options):
    options = QUICK | options
    cairn.build(cairn.load_mesh(file), **options).save(tmp_path / "python.cairn")
    words = [word for name, value in options.items() for word in (f"--{name}", value)]
    done = command("build", file, "-o", tmp_path / "command.cairn", "--no-evaluate", *words)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "python.cairn").read_bytes() == (tmp_path / "command.cairn").read_bytes()


def test_arrays_give_the_spheres_of_the_file(file):
    mesh = cairn.load_mesh(file)
    again = cairn.TriangleMesh(mesh.vertices, mesh.triangles)
    of_file, of_arrays = cairn.build(mesh, **QUICK), cairn.build(again, **QUICK)
    for name in ("centers", "radii", "errors", "parents"):
        assert (getattr(of_file, name) == getattr(of_arrays, name)).all()
    assert of_arrays.info["mesh"] == "" and of_file.info["mesh"] == "lump.obj"


@pytest.mark.parametrize("options", [{"depth": 0}, {"depth": 9}, {"branching": 1}, {"samples": 99}, {"method": "octre"},
                                     {"method": "octree", "branching": 4}, {"optimise": "more"},
                                     {"method": "octree", "balance": 0.1}, {"balance": "much"}])
def test_options_are_refused_with_the_builders_sentence(mesh, options):
    with pytest.raises(cairn.Error) as caught:
        cairn.build(mesh, **options)
    assert len(str(caught.value)) > 20 and "\n" not in str(caught.value)


@pytest.mark.parametrize("options, sentence", [({"depth": -1}, "depth cannot be -1"),
                                               ({"samples": 1 << 40}, "samples cannot be 1099511627776"),
                                               ({"seed": -1}, "'-1' is not a whole number from 0"),
                                               ({"seed": 1 << 64}, "'18446744073709551616' is not a whole number"),
                                               ({"threads": -2}, "threads cannot be -2"),
                                               ({"threads": 1025}, "threads cannot be 1025")])
def test_numbers_out_of_range_are_refused_in_a_sentence(mesh, options, sentence):
    with pytest.raises(cairn.Error, match=sentence):
        cairn.build(mesh, **options)


def test_other_types_raise_type_error(mesh):
    for wrong in (None, "rock.obj", 3, mesh.vertices):
        with pytest.raises(TypeError):
            cairn.build(wrong)
    with pytest.raises(TypeError):
        cairn.build(mesh, depth=2.5)
    with pytest.raises(TypeError):
        cairn.build(mesh, 3)  # options have names


def test_certify_proves_trees_and_refutes_false_ones(mesh, tree):
    proof = cairn.certify(mesh, tree)
    assert proof.proven and proof.failures == []
    assert [level.spheres for level in proof.levels] == [len(tree.cut(i)) for i in range(tree.depth + 1)]
    assert all(level.coverage_proven and level.reachable_proven for level in proof.levels)
    assert (proof.errors_at_least <= tree.errors).all() and (tree.errors <= proof.errors_at_most * (1 + 1e-6) + 1e-3).all()
    assert proof.depths.shape == (len(tree),)
    false = cairn.certify(cairn.TriangleMesh(mesh.vertices * 1.5, mesh.triangles), tree)
    assert not false.proven and false.failures and not false.levels[-1].coverage_proven


def test_evaluate_agrees_with_the_command_line(file, tmp_path, command):
    mesh = cairn.load_mesh(file)
    tree = cairn.build(mesh, depth=1, samples=500)
    tree.save(tmp_path / "lump.cairn")
    said = json.loads(command("evaluate", file, tmp_path / "lump.cairn", "--json", "-").stdout)["levels"]
    fits = cairn.evaluate(mesh, tree)
    assert len(fits) == len(said) == 1
    for key in ("certified_max_fraction", "sampled_max_fraction", "uncovered_area_fraction", "wasted_volume_fraction",
                "spheres", "coverage_proven"):
        assert getattr(fits[0], key) == said[0][key], key
    assert cairn.evaluate(mesh, tree, sampled=False)[0].sampled_max_fraction == 0


@pytest.mark.parametrize("objective", ["outer", "balanced", "inner", "volume"])
def test_a_cover_is_that_of_the_command_line_and_proved(file, tmp_path, command, objective):
    mesh = cairn.load_mesh(file)
    cover = cairn.cover(mesh, 5, objective=objective)
    assert len(cover) == 5 and cover.centers.shape == (5, 3) and cover.objective == objective and cover.error > 0
    cover.save(tmp_path / "python.txt")
    assert command("cover", file, "--spheres", 5, "--objective", objective, "-o", tmp_path / "command.txt",
                   "--no-evaluate").returncode == 0
    assert (tmp_path / "python.txt").read_bytes() == (tmp_path / "command.txt").read_bytes()
    spheres = np.column_stack([cover.centers, cover.radii])
    again = cairn.certify(mesh, spheres)
    assert again.sticks_out.at_most == cover.certificate.sticks_out.at_most
    assert again.surface_covered == (objective in ("outer", "volume"))
    assert (cover.inner_radii <= cover.radii).all() and (cover.errors >= 0).all()


def test_a_cover_keeps_an_error_or_a_mirror_plane(mesh):
    cover = cairn.cover(mesh, max_error=0.5)
    assert cover.error <= 0.5 and cover.mirror is None
    normal, offset = cairn.cover(mesh, 4, symmetric=True).mirror
    assert np.linalg.norm(normal) == pytest.approx(1) and abs(offset) < 1e-6
    for wrong in ({}, {"spheres": 3, "max_error": 0.1}, {"spheres": 0}, {"spheres": 5000}, {"max_error": -1.0},
                  {"max_error": float("nan")}, {"spheres": 3, "objective": "best"}):
        with pytest.raises(cairn.Error):
            cairn.cover(mesh, **wrong)


def test_views_of_a_cover_outlive_it(mesh):
    cover = cairn.cover(mesh, 3)
    centers, errors, proof = cover.centers, cover.errors, cover.certificate
    kept = centers.copy(), errors.copy()
    del cover
    assert (centers == kept[0]).all() and (errors == kept[1]).all() and proof.sticks_out.at_most > 0
    with pytest.raises(ValueError):
        centers[0] = 0


@pytest.mark.parametrize("spheres, sentence", [
    (np.zeros((0, 4)), "spheres is empty"), (np.zeros((3, 3)), r"shape \(n, 4\), not \(3, 3\)"),
    (np.zeros((1, 4)), r"spheres\[0\] has the radius 0"), (np.full((1, 4), np.nan), "not finite"),
    (np.ones((1, 4), int), "float64 or float32"), ([[0, 0, 0, 1]], "not list"), (None, "not NoneType")])
def test_spheres_of_others_are_checked(mesh, spheres, sentence):
    for use in (lambda: cairn.certify(mesh, spheres), lambda: cairn.evaluate(mesh, spheres),
                lambda: cairn.export(spheres, "never", to="clump")):
        with pytest.raises(cairn.Error, match=sentence):
            use()


@pytest.mark.parametrize("form", ["spheres", "sph", "obj", "glb", "liggghts", "yade", "chrono", "clump"])
def test_every_form_is_that_of_the_command_line(tree, tmp_path, command, form):
    tree.save(tmp_path / "ball.cairn")
    ending = form if form in ("obj", "glb") else "txt"
    cairn.export(tree, tmp_path / f"python.{ending}", to=form)
    done = command("export", tmp_path / "ball.cairn", "--to", form, "-o", tmp_path / f"command.{ending}")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / f"python.{ending}").read_bytes() == (tmp_path / f"command.{ending}").read_bytes()


def test_forms_are_refused_that_do_not_fit(mesh, tree, tmp_path):
    flat = np.array([[0, 0, 0, 1.0]])
    for spheres, options, sentence in ((tree, {"to": "stl"}, "no form 'stl'; choose one of spheres"),
                                       (tree, {"to": "sph", "level": 1}, "level is for single levels"),
                                       (tree, {"to": "obj", "level": 9}, "levels 0 to 2, not 9"),
                                       (tree, {"to": "obj", "mesh": mesh}, "mesh is for grains"),
                                       (flat, {"to": "spheres"}, "a flat set of spheres has no levels"),
                                       (flat, {"to": "clump", "level": 0}, "a flat set of spheres has no levels")):
        with pytest.raises(cairn.Error, match=sentence):
            cairn.export(spheres, tmp_path / "x", **options)
    with pytest.raises(cairn.Error, match="nowhere"):
        cairn.export(flat, tmp_path / "nowhere" / "x", to="clump")
    assert list(tmp_path.iterdir()) == []
    cairn.export(flat, tmp_path / "grain.txt", to="liggghts", mesh=mesh)
    assert len((tmp_path / "grain.txt").read_text().split()) == 4
