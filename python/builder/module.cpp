// SPDX-License-Identifier: GPL-3.0-or-later
//
// cairn._builder: meshes in, proved spheres out. GPL, because the builder is.
#include <pybind11/pybind11.h>

#include "builder/types.h"
#include "builder/waiting.h"

namespace py = pybind11;

PYBIND11_MODULE(_builder, module) {
  module.doc() = "Sphere-trees and covers of meshes, with proofs. GPL-3.0-or-later, like the builder.";
  py::module_::import("cairn._core");  // whose SphereTree and Error are used here
  cairn::python::prepareThreads();
  py::module_::import("atexit").attr("register")(py::cpp_function(&cairn::python::joinThreads));
  cairn::python::bindMesh(module);
  cairn::python::bindBuild(module);
  cairn::python::bindCertify(module);
  cairn::python::bindCover(module);
  cairn::python::bindEvaluate(module);
  cairn::python::bindExport(module);
}
