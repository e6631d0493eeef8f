// SPDX-License-Identifier: Zlib
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "cairn/core/result.h"

namespace cairn::python {

/// Raises `cairn.Error` with this sentence. The class lives in `cairn._core`; both modules raise the same one.
[[noreturn]] inline void refuse(const std::string& sentence) {
  const pybind11::object type = pybind11::module_::import("cairn._core").attr("Error");
  PyErr_SetString(type.ptr(), sentence.c_str());
  throw pybind11::error_already_set();
}

/// Returns the value, or raises the error's sentence. The interpreter's lock is held.
template <class T>
T valueOf(Result<T> result) {
  if (!result) refuse(result.error().message);
  return std::move(result).value();
}

/// Raises the error's sentence, if there is one. The interpreter's lock is held.
inline void require(const Status& status) {
  if (!status) refuse(status.error().message);
}

}  // namespace cairn::python
