// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cairn/builder/grain.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::tool {

/// What is exported: a tree and the spheres of one of its levels, or a flat cover.
struct ExportSource {
  std::optional<SphereTree> tree;
  std::uint32_t level = 0;  ///< of the tree
  std::vector<builder::Ball> balls;
  MassProperties mass;  ///< of the mesh where it is known, else of the union of the spheres
  bool massOfMesh = false;
};

/// What of the source a form holds.
enum class ExportPart : std::uint8_t {
  tree,     ///< the whole tree; covers have none
  mesh,     ///< the mesh of a level; covers have none
  spheres,  ///< the spheres of a level, or a cover
  grain,    ///< these about their body's centre of mass, with its mass
};

/// The frame the file's coordinates are in.
enum class ExportFrame : std::uint8_t { mesh, centreOfMass, principalAxes };

/// A form `cairn export` writes. All forms stand in one table, in export_formats.cpp: a new one is a row there, the
/// function that makes its text, and a test.
struct ExportFormat {
  const char* name;
  const char* about;      ///< one line of the help
  const char* extension;  ///< a name's ending this form alone may have; empty: any
  ExportPart part;
  ExportFrame frame;
  Status (*write)(const ExportSource& source, const std::filesystem::path& path);
};

std::span<const ExportFormat> exportFormats();
std::vector<std::string> exportFormatNames();
/// Precondition: a name of the table.
const ExportFormat& exportFormat(const std::string& name);

}  // namespace cairn::tool
