// SPDX-License-Identifier: GPL-3.0-or-later
#include "builder/mesh_arrays.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "common/errors.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

/// The numbers of a table, whatever its strides and alignment.
template <class T>
class Table {
 public:
  explicit Table(const py::array& array)
      : data_(static_cast<const char*>(array.data())), row_(array.strides(0)), column_(array.strides(1)) {}

  T operator()(py::ssize_t row, py::ssize_t column) const {
    T value;
    std::memcpy(&value, data_ + row * row_ + column * column_, sizeof(T));
    return value;
  }

 private:
  const char* data_;
  py::ssize_t row_, column_;
};

std::string typeName(const py::handle& object) {
  return py::str(py::type::of(object).attr("__name__"));
}

std::string shapeText(const py::array& array) {
  return py::str(array.attr("shape"));
}

/// The array itself, once it is a plain table of so many columns.
py::array tableOf(const py::object& object, const char* name, py::ssize_t columns, const char* types) {
  if (!py::isinstance<py::array>(object))
    refuse(fmt::format("{} must be a NumPy array of shape (n, {}), not {}; numpy.asarray makes one", name, columns,
                       typeName(object)));
  if (py::hasattr(object, "mask")) refuse(fmt::format("{} must not be masked; fill or leave out what is masked", name));
  auto array = py::reinterpret_borrow<py::array>(object);
  if (array.ndim() != 2 || array.shape(1) != columns)
    refuse(fmt::format("{} must have the shape (n, {}), not {}", name, columns, shapeText(array)));
  const std::string type = py::str(array.dtype());
  if (!array.dtype().attr("isnative").cast<bool>())
    refuse(fmt::format("{} has another byte order than this machine ({}); convert it with astype", name, type));
  const char kind = array.dtype().kind();
  const py::ssize_t bytes = array.itemsize();
  const bool fits = std::strchr(types, kind) != nullptr && (bytes == 4 || bytes == 8);
  if (!fits && *types == 'f')
    refuse(fmt::format("{} must hold float64 or float32, not {}; convert it with astype", name, type));
  if (!fits)
    refuse(fmt::format("{} must hold whole numbers of 32 or 64 bits, not {}; convert it with astype", name, type));
  return array;
}

template <class T>
std::vector<Vec3d> vertices(const py::array& array) {
  const Table<T> table(array);
  std::vector<Vec3d> points(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const Vec3d point{static_cast<double>(table(i, 0)), static_cast<double>(table(i, 1)),
                      static_cast<double>(table(i, 2))};
    if (!isFinite(point))
      refuse(fmt::format("vertices[{}] is ({}, {}, {}), which is not finite; remove or correct it", i, point.x, point.y,
                         point.z));
    points[static_cast<std::size_t>(i)] = point;
  }
  return points;
}

template <class T>
std::vector<builder::Triangle> triangles(const py::array& array, std::size_t vertexCount) {
  const Table<T> table(array);
  std::vector<builder::Triangle> all(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const T index = table(i, corner);
      if (std::cmp_less(index, 0) || std::cmp_greater_equal(index, vertexCount))
        refuse(fmt::format("triangles[{}] names vertex {}, and vertices has {} rows (numbers count from 0); correct it",
                           i, index, vertexCount));
      all[static_cast<std::size_t>(i)][static_cast<std::size_t>(corner)] = static_cast<std::uint32_t>(index);
    }
  }
  return all;
}

std::vector<builder::Triangle> trianglesOf(const py::array& array, std::size_t vertexCount) {
  const bool isSigned = array.dtype().kind() == 'i';
  if (array.itemsize() == 4)
    return isSigned ? triangles<std::int32_t>(array, vertexCount) : triangles<std::uint32_t>(array, vertexCount);
  return isSigned ? triangles<std::int64_t>(array, vertexCount) : triangles<std::uint64_t>(array, vertexCount);
}

void checkCount(const py::array& array, const char* name) {
  constexpr py::ssize_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (array.shape(0) == 0) refuse(fmt::format("{} is empty; a mesh needs at least four vertices and triangles", name));
  if (array.shape(0) >= kMost)
    refuse(fmt::format("{} has {} rows, and a mesh at most {}; simplify it first", name, array.shape(0), kMost - 1));
}

template <class T>
std::vector<builder::Ball> balls(const py::array& array) {
  const Table<T> table(array);
  std::vector<builder::Ball> all;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    const Vec3d center{static_cast<double>(table(i, 0)), static_cast<double>(table(i, 1)),
                       static_cast<double>(table(i, 2))};
    const auto radius = static_cast<double>(table(i, 3));
    if (!isFinite(center) || !std::isfinite(radius))
      refuse(fmt::format("spheres[{}] is ({}, {}, {}, {}), which is not finite; remove or correct it", i, center.x,
                         center.y, center.z, radius));
    if (!(radius > 0)) refuse(fmt::format("spheres[{}] has the radius {}; it must be above 0", i, radius));
    all.push_back({center, radius, 0});
  }
  return all;
}

}  // namespace

builder::TriangleMesh meshOfArrays(const py::object& vertexArray, const py::object& triangleArray,
                                   const std::string& name) {
  const py::array points = tableOf(vertexArray, "vertices", 3, "f");
  const py::array corners = tableOf(triangleArray, "triangles", 3, "iu");
  checkCount(points, "vertices");
  checkCount(corners, "triangles");
  builder::TriangleMesh mesh;
  mesh.name = name;
  mesh.vertices = points.itemsize() == 4 ? vertices<float>(points) : vertices<double>(points);
  mesh.triangles = trianglesOf(corners, mesh.vertices.size());
  return mesh;
}

std::vector<builder::Ball> ballsOfArray(const py::object& spheres) {
  const py::array table = tableOf(spheres, "spheres", 4, "f");
  if (table.shape(0) == 0) refuse("spheres is empty; give at least one row `x y z r`");
  return table.itemsize() == 4 ? balls<float>(table) : balls<double>(table);
}

}  // namespace cairn::python
