// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <limits>

#include "builder/types.h"
#include "common/errors.h"

namespace py = pybind11;

namespace cairn::python {

std::uint32_t countOf(const char* option, std::int64_t value) {
  constexpr std::int64_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (value < 0 || value > kMost)
    refuse(fmt::format("{} cannot be {}; it is a number from 0 to {}", option, value, kMost));
  return static_cast<std::uint32_t>(value);
}

unsigned threadsOf(std::int64_t value) {
  constexpr std::int64_t kMost = 1024;
  if (value < 0 || value > kMost)
    refuse(fmt::format("threads cannot be {}; it is a number from 1 to {}, or 0 for one per core", value, kMost));
  return static_cast<unsigned>(value);
}

std::uint64_t seedOf(const py::int_& value) {
  const unsigned long long seed = PyLong_AsUnsignedLongLong(value.ptr());
  if (PyErr_Occurred() == nullptr) return seed;
  PyErr_Clear();
  refuse(fmt::format("'{}' is not a whole number from 0 to 18446744073709551615",
                     std::string(py::str(py::handle(value)))));
}

}  // namespace cairn::python
