// SPDX-License-Identifier: Zlib
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <span>

#include "cairn/core/vec3.h"

namespace cairn::python {

/// Marks an array as read-only. NumPy does not let a user undo this, because the owner exports no writable memory.
inline pybind11::array readOnly(pybind11::array array) {
  pybind11::detail::array_proxy(array.ptr())->flags &= ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Read-only view of one number in each record of a row; nothing is copied. `first` is that of the first record.
/// `owner` is the Python object that holds the records: the view keeps it alive. Shape (n,).
template <class Record, class T>
pybind11::array columnOf(std::span<const Record> records, const T* first, const pybind11::object& owner) {
  return readOnly(pybind11::array(pybind11::dtype::of<T>(), {records.size()}, {sizeof(Record)}, first, owner));
}

/// The same for a point in each record. Shape (n, 3).
template <class Record, class T>
pybind11::array pointsOf(std::span<const Record> records, const BasicVec3<T>* first, const pybind11::object& owner) {
  static_assert(sizeof(BasicVec3<T>) == 3 * sizeof(T));
  return readOnly(pybind11::array(pybind11::dtype::of<T>(), {records.size(), std::size_t{3}},
                                  {sizeof(Record), sizeof(T)}, first, owner));
}

/// The same for triples of indices. Shape (n, 3).
template <class Triple>
pybind11::array triplesOf(std::span<const Triple> triples, const pybind11::object& owner) {
  using Index = typename Triple::value_type;
  return readOnly(pybind11::array(pybind11::dtype::of<Index>(), {triples.size(), std::size_t{3}},
                                  {sizeof(Triple), sizeof(Index)}, triples.data(), owner));
}

}  // namespace cairn::python
