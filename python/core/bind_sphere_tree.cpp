// SPDX-License-Identifier: Zlib
#include "core/bind_sphere_tree.h"

#include <pybind11/numpy.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "cairn/core/tree_file.h"
#include "common/errors.h"
#include "common/views.h"
#include "core/node_numbers.h"

namespace py = pybind11;

namespace cairn::python {
namespace {

using TreePointer = std::shared_ptr<SphereTree>;
using TreeClass = py::class_<SphereTree, TreePointer>;

TreePointer shared(Result<SphereTree> tree) {
  return std::make_shared<SphereTree>(valueOf(std::move(tree)));
}

TreePointer load(const std::filesystem::path& path) {
  return shared([&] {
    const py::gil_scoped_release released;
    return loadTree(path);
  }());
}

TreePointer fromBytes(const py::bytes& bytes) {
  const std::string_view view = bytes;  // immutable, and held by the caller
  return shared([&] {
    const py::gil_scoped_release released;
    return decodeTree(std::as_bytes(std::span(view)));
  }());
}

void save(const TreePointer& tree, const std::filesystem::path& path) {
  const Status status = [&] {
    const py::gil_scoped_release released;
    return saveTree(*tree, path);
  }();
  require(status);
}

py::bytes toBytes(const SphereTree& tree) {
  const std::vector<std::byte> bytes = encodeTree(tree);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Counts from the end where it is negative, as Python does; raises IndexError beyond the end.
std::uint32_t indexOf(py::ssize_t index, std::uint32_t count, const char* kind) {
  const py::ssize_t fromStart = index < 0 ? index + count : index;
  if (fromStart < 0 || fromStart >= count)
    throw py::index_error("the tree has " + std::to_string(count) + " " + kind + ", and none is number " +
                          std::to_string(index));
  return static_cast<std::uint32_t>(fromStart);
}

std::uint32_t levelOf(const SphereTree& tree, py::ssize_t level) {
  return indexOf(level, tree.depth() + 1, "levels");
}

py::slice sliceOf(const NodeRange& range) {
  return {static_cast<py::ssize_t>(range.first), static_cast<py::ssize_t>(range.second), 1};
}

/// Which member of every node a view shows.
template <auto member>
py::array nodeView(const py::object& self) {
  const std::span<const NodeData> nodes = self.cast<const SphereTree&>().data().nodes;
  if constexpr (std::is_same_v<decltype(member), Vec3 NodeData::*>)
    return pointsOf(nodes, &(nodes.front().*member), self);
  else
    return columnOf(nodes, &(nodes.front().*member), self);
}

py::array vertices(const py::object& self) {
  const std::span<const Vec3> points = self.cast<const SphereTree&>().vertices();
  return pointsOf(points, points.data(), self);
}

py::array triangles(const py::object& self) {
  return triplesOf(self.cast<const SphereTree&>().triangles(), self);
}

py::array regionTriangles(const py::object& self, py::ssize_t node) {
  const auto& tree = self.cast<const SphereTree&>();
  const auto list = tree.regionTriangles(tree.nodeAt(indexOf(node, tree.nodeCount(), "nodes")));
  return columnOf(list, list.data(), self);
}

py::array cut(const SphereTree& tree, py::ssize_t level) {
  const std::vector<std::uint32_t> numbers = cutOf(tree, levelOf(tree, level));
  return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::array inertia(const SphereTree& tree) {
  py::array_t<double> matrix({3, 3});
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) matrix.mutable_at(row, column) = tree.mass().inertia(row, column);
  return matrix;
}

py::tuple tupleOf(const Vec3d& v) {
  return py::make_tuple(v.x, v.y, v.z);
}

py::dict info(const SphereTree& tree) {
  using namespace py::literals;
  const BuildInfo& i = tree.info();
  return py::dict("mesh"_a = i.meshName, "mesh_sha256"_a = i.meshSha256, "method"_a = i.method,
                  "branching"_a = i.branching, "depth"_a = i.depth, "samples"_a = i.samples, "seed"_a = i.seed);
}

std::string represent(const SphereTree& tree) {
  return "<cairn.SphereTree of " + std::to_string(tree.nodeCount()) + " nodes on levels 0 to " +
         std::to_string(tree.depth()) + ">";
}

void addFiles(TreeClass& tree) {
  tree.def("save", &save, py::arg("path"),
           "Writes a `.cairn` file, whole or not at all. Raises cairn.Error when it cannot be written.");
  tree.def("to_bytes", &toBytes, "The bytes of the `.cairn` file: the same tree gives the same bytes.");
  tree.def_static("from_bytes", &fromBytes, py::arg("data"),
                  "Reads the bytes of a `.cairn` file. Nothing in them is trusted; raises cairn.Error.");
}

void addNodes(TreeClass& tree) {
  tree.def_property_readonly("centers", &nodeView<&NodeData::center>,
                             "Centres of the nodes' balls, shape (n, 3), float32, tree frame (see `origin`). "
                             "Breadth-first, the root first. A read-only view.");
  tree.def_property_readonly("radii", &nodeView<&NodeData::radius>,
                             "Radii of the nodes' balls, shape (n,), float32, mesh unit. A read-only view.");
  tree.def_property_readonly("errors", &nodeView<&NodeData::error>,
                             "Certified errors: no point of a ball is farther from the solid. Shape (n,), float32, "
                             "mesh unit. A read-only view.");
  tree.def_property_readonly("inner_radii", &nodeView<&NodeData::innerRadius>,
                             "Radii of concentric balls inside the solid, 0 where the centre is outside. Shape (n,), "
                             "float32, mesh unit. A read-only view.");
  tree.def_property_readonly("parents", &nodeView<&NodeData::parent>,
                             "Number of each node's parent; the root's is 0. Shape (n,), uint32. A read-only view.");
  tree.def(
      "children",
      [](const SphereTree& t, py::ssize_t node) {
        return sliceOf(childrenOf(t, indexOf(node, t.nodeCount(), "nodes")));
      },
      py::arg("node"), "The node's children as a slice for the arrays; empty for a leaf. Raises IndexError.");
  tree.def(
      "region_triangles", &regionTriangles, py::arg("node"),
      "The triangles that touch the node's region, as rows of `triangles`; some more than once. Shape (k,), uint32. A "
      "read-only view. Raises IndexError.");
}

void addLevels(TreeClass& tree) {
  tree.def_property_readonly("depth", &SphereTree::depth, "Levels below the root; 0 for a lone root.");
  tree.def_property_readonly("leaf_count", &SphereTree::leafCount, "How many nodes have no children.");
  tree.def(
      "level_nodes", [](const SphereTree& t, py::ssize_t level) { return sliceOf(nodesOfLevel(t, levelOf(t, level))); },
      py::arg("level"),
      "The nodes at one depth as a slice for the arrays: `tree.radii[tree.level_nodes(2)]`. Level -1 is the deepest. "
      "Raises IndexError.");
  tree.def("cut", &cut, py::arg("level"),
           "Numbers of all nodes of a level and of all leaves above it: together they cover the surface. Shape (k,), "
           "uint32, a new array. Raises IndexError.");
  tree.def(
      "level_error", [](const SphereTree& t, py::ssize_t level) { return t.levelError(levelOf(t, level)); },
      py::arg("level"), "The worst certified error of `cut(level)`, mesh unit. Raises IndexError.");
}

void addMesh(TreeClass& tree) {
  tree.def_property_readonly("vertices", &vertices,
                             "Vertices of the source mesh, shape (v, 3), float32, tree frame. A read-only view.");
  tree.def_property_readonly("triangles", &triangles,
                             "Triangles of the source mesh as rows of `vertices`, counter-clockwise from outside. "
                             "Shape (t, 3), uint32. A read-only view.");
  tree.def_property_readonly(
      "origin", [](const SphereTree& t) { return tupleOf(t.origin()); },
      "Where the tree frame's origin lies in the mesh's frame, three floats: `tree.centers + tree.origin`.");
  tree.def_property_readonly(
      "volume", [](const SphereTree& t) { return t.mass().volume; }, "Volume of the solid, mesh unit cubed.");
  tree.def_property_readonly(
      "center_of_mass", [](const SphereTree& t) { return tupleOf(t.mass().centerOfMass); },
      "Centre of mass of the solid at uniform density, mesh frame, three floats.");
  tree.def_property_readonly("inertia", &inertia,
                             "Inertia about the centre of mass, per unit of mass, mesh axes, mesh unit squared. Shape "
                             "(3, 3), float64, a new array.");
  tree.def_property_readonly("info", &info, "How the tree came to be: mesh, method and options, as a new dict.");
  tree.def_property_readonly("memory_bytes", &SphereTree::memoryBytes, "Bytes of memory the tree holds.");
}

}  // namespace

void bindSphereTree(py::module_& module) {
  TreeClass tree(module, "SphereTree",
                 "An immutable tree of balls around a mesh, each with a proved error. Made by `cairn.build` or read by "
                 "`cairn.load`; safe to use from any thread. Arrays are read-only views that keep the tree alive.");
  tree.attr("__module__") = "cairn";
  addFiles(tree);
  addNodes(tree);
  addLevels(tree);
  addMesh(tree);
  tree.def("__len__", &SphereTree::nodeCount);
  tree.def("__repr__", &represent);
  tree.def("__eq__", [](const SphereTree& a, const py::object& b) {
    return py::isinstance<SphereTree>(b) && a.data() == b.cast<const SphereTree&>().data();
  });
  tree.def("__hash__", [](const py::object& self) { return py::hash(self.attr("to_bytes")()); });
  tree.def("__copy__", [](const py::object& self) { return self; });
  tree.def(
      "__deepcopy__", [](const py::object& self, const py::dict&) { return self; }, py::arg("memo"));
  module.def("load", &load, py::arg("path"),
             "Reads a `.cairn` file. Nothing in it is trusted; raises cairn.Error with the file's name.");
}

}  // namespace cairn::python
