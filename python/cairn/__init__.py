# SPDX-License-Identifier: Zlib
"""Certified sphere-trees: spheres around a mesh, each with a proved error.

    import cairn
    mesh = cairn.TriangleMesh(vertices, triangles)
    tree = cairn.build(mesh, depth=3)
    print(tree.level_error(-1) / mesh.diagonal)

`load` and `SphereTree` need nothing else and have the zlib licence. Everything that takes a mesh is the builder's, which is
GPL-3.0-or-later; `has_builder` tells whether it is there.
"""
import importlib.util as _util

from cairn._core import Error, SphereTree, __version__, load

__all__ = ["Error", "SphereTree", "__version__", "has_builder", "load"]

_OF_BUILDER = ("Cover", "EnclosedDistance", "LevelCertificate", "LevelFit", "SpheresCertificate", "TreeCertificate",
               "TriangleMesh", "build", "certify", "cover", "evaluate", "export", "load_mesh")

has_builder = _util.find_spec("cairn._builder") is not None
"""Whether the part that takes meshes was built."""

if has_builder:
    from cairn._builder import (Cover, EnclosedDistance, LevelCertificate, LevelFit, SpheresCertificate, TreeCertificate,
                                TriangleMesh, build, certify, cover, evaluate, export, load_mesh)
    __all__ += _OF_BUILDER


def __getattr__(name):
    if name in _OF_BUILDER:
        raise ImportError(f"cairn.{name} is part of the builder, which this package was built without; "
                          "build it with -DCAIRN_BUILDER=ON, or read finished trees with cairn.load", name="cairn._builder")
    raise AttributeError(f"module 'cairn' has no attribute '{name}'")
