// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/export_formats.h"

#include <algorithm>
#include <array>

#include "cairn/builder/export.h"
#include "cairn/builder/level_meshes.h"
#include "cairn/builder/simplify.h"
#include "cairn/core/atomic_file.h"

namespace cairn::tool {
namespace {

using builder::Grain;
using std::filesystem::path;

Status writeSpheres(const ExportSource& source, const path& file) {
  return writeFileAtomically(file, builder::spheresText(*source.tree));
}

Status writeSph(const ExportSource& source, const path& file) {
  const Result<std::string> text = builder::sphText(*source.tree);
  return text ? writeFileAtomically(file, text.value()) : text.error();
}

// Levels without a mesh of their own are served by the source.
Status writeMesh(const ExportSource& source, const path& file) {
  const SphereTree& tree = *source.tree;
  if (source.level == 0) return Error{"level 0 is the root, which has no mesh; ask for level 1 or deeper"};
  return writeFileAtomically(
      file, builder::objText(source.level <= tree.levelMeshCount() ? builder::levelMeshOf(tree, source.level)
                                                                   : builder::sourceMeshOf(tree)));
}

template <builder::SurfaceFormat format>
Status writeSurfaces(const ExportSource& source, const path& file) {
  return builder::writeSphereSurfaces(source.balls, format, file);
}

template <std::string (*text)(const Grain&)>
Status writeGrain(const ExportSource& source, const path& file) {
  return writeFileAtomically(file, text(Grain{source.balls, source.mass}));
}

constexpr std::array kFormats{
    ExportFormat{"spheres", "text, one line `level x y z r parent` per sphere, breadth-first", "", ExportPart::tree,
                 ExportFrame::mesh, writeSpheres},
    ExportFormat{"sph", "text of Bradshaw's sphere-tree toolkit", "", ExportPart::tree, ExportFrame::mesh, writeSph},
    ExportFormat{"mesh", "OBJ, the mesh of a level (`cairn build --level-meshes`), to draw instead of the source",
                 ".obj", ExportPart::mesh, ExportFrame::mesh, writeMesh},
    ExportFormat{"obj", "the spheres as a surface, for looking at", ".obj", ExportPart::spheres, ExportFrame::mesh,
                 writeSurfaces<builder::SurfaceFormat::obj>},
    ExportFormat{"glb", "the same, binary", ".glb", ExportPart::spheres, ExportFrame::mesh,
                 writeSurfaces<builder::SurfaceFormat::glb>},
    ExportFormat{"liggghts", "LIGGGHTS multisphere template, `x y z r`, about the centre of mass", "",
                 ExportPart::grain, ExportFrame::centreOfMass, writeGrain<builder::liggghtsText>},
    ExportFormat{"yade", "YADE clump for ymport.textClumps, about the centre of mass", "", ExportPart::grain,
                 ExportFrame::centreOfMass, writeGrain<builder::yadeText>},
    ExportFormat{"chrono", "Chrono DEM clump, CSV `x,y,z,r`, about the centre of mass in principal axes", "",
                 ExportPart::grain, ExportFrame::principalAxes, writeGrain<builder::chronoText>},
    ExportFormat{"clump", "CLUMP text, `x,y,z,r` without a head, the mesh's frame", "", ExportPart::grain,
                 ExportFrame::mesh, writeGrain<builder::clumpText>},
};

}  // namespace

std::span<const ExportFormat> exportFormats() {
  return kFormats;
}

std::vector<std::string> exportFormatNames() {
  std::vector<std::string> names;
  for (const ExportFormat& format : kFormats) names.emplace_back(format.name);
  return names;
}

const ExportFormat& exportFormat(const std::string& name) {
  return *std::find_if(kFormats.begin(), kFormats.end(), [&](const ExportFormat& f) { return name == f.name; });
}

}  // namespace cairn::tool
