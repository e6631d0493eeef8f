// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>

#include "cairn/builder/cover.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::python {

/// Python's `TriangleMesh`: a mesh that has passed `checkMesh`, and never changes.
struct SolidMesh {
  builder::TriangleMesh mesh;
  std::string changes;  ///< one sentence on repair or wrap; empty: as it was given
};

/// Python's `Cover`.
struct FlatCover {
  builder::Cover cover;
  builder::Objective objective = builder::Objective::outer;
};

using MeshPointer = std::shared_ptr<SolidMesh>;
using CoverPointer = std::shared_ptr<FlatCover>;
using TreePointer = std::shared_ptr<SphereTree>;

/// A whole number from Python for an option; raises cairn.Error where it does not fit 32 bits.
std::uint32_t countOf(const char* option, std::int64_t value);
/// A number of threads, 0 to 1024; raises cairn.Error.
unsigned threadsOf(std::int64_t value);
/// Any Python whole number of 64 bits; raises cairn.Error with the command line's sentence.
std::uint64_t seedOf(const pybind11::int_& value);

/// Each adds a part of the module.
void bindMesh(pybind11::module_& module);
void bindBuild(pybind11::module_& module);
void bindCover(pybind11::module_& module);
void bindCertify(pybind11::module_& module);
void bindEvaluate(pybind11::module_& module);
void bindExport(pybind11::module_& module);

}  // namespace cairn::python
