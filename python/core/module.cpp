// SPDX-License-Identifier: Zlib
//
// cairn._core: sphere-trees and their file, without anything of the builder's licence.
#include <pybind11/pybind11.h>

#include "cairn/core/version.h"
#include "core/bind_sphere_tree.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  module.doc() = "Certified sphere-trees: load, save and look at them. zlib licence.";
  module.attr("__version__") = cairn::version();
  const auto error = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "cairn.Error", "Input was refused or work failed. The text is one sentence: where, what, and what to do.",
      PyExc_Exception, nullptr));
  module.attr("Error") = error;
  cairn::python::bindSphereTree(module);
}
