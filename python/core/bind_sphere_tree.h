// SPDX-License-Identifier: Zlib
#pragma once

#include <pybind11/pybind11.h>

namespace cairn::python {

/// Adds `SphereTree` and `load`.
void bindSphereTree(pybind11::module_& module);

}  // namespace cairn::python
