// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/mesh_source.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <utility>

#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "cairn/core/atomic_file.h"
#include "tool/interrupt.h"

namespace cairn::tool {
namespace {

Result<MeshSource> repaired(const builder::TriangleMesh& surface, const builder::RepairOptions& options) {
  builder::RepairCounts counts;
  Result<builder::TriangleMesh> mesh = builder::repair(surface, &counts, options);
  if (!mesh) return Error{mesh.error().message + "; try --wrap, or a larger --weld where parts are apart"};
  return MeshSource{std::move(mesh).value(), counts, options, {}};
}

Result<MeshSource> wrapped(const builder::TriangleMesh& surface, const builder::WrapOptions& options,
                           const builder::ProgressCallback& progress) {
  Result<builder::Wrap> wrap = builder::wrap(surface, options, progress);
  if (!wrap) return wrap.error();
  MeshSource source{std::exchange(wrap.value().mesh, {}), {}, {}, {}};
  source.wrap = std::move(wrap).value();
  return source;
}

/// No point of a ball of the level outside the wrap is farther from the original surface; of the wrap's diagonal, like
/// the other fractions of a report.
double originalMaxFraction(const MeshSource& source, const builder::LevelFit& fit) {
  return fit.certifiedMaxFraction + source.wrap->farthestUpper / boundsOf(source.mesh).diagonal();
}

Json repairJson(const builder::RepairCounts& counts, const builder::RepairOptions& options) {
  return {{"weld_fraction", options.weld},
          {"duplicate_triangles", counts.duplicateTriangles},
          {"joined_vertices", counts.joinedVertices},
          {"split_triangles", counts.splitTriangles},
          {"collapsed_triangles", counts.collapsedTriangles},
          {"filled_holes", counts.filledHoles},
          {"added_triangles", counts.addedTriangles},
          {"turned_triangles", counts.turnedTriangles},
          {"moved_triangles", counts.movedTriangles},
          {"closed_gaps", counts.closedGaps},
          {"united_bodies", counts.unitedBodies},
          {"enclosed_bodies", counts.enclosedBodies},
          {"cut_triangles", counts.cutTriangles},
          {"folded_triangles", counts.foldedTriangles},
          {"thickened_edges", counts.beadedEdges}};
}

Json wrapJson(const MeshSource& source) {
  const double diagonal = boundsOf(source.mesh).diagonal();
  return {{"alpha_fraction", source.wrap->alpha},
          {"offset_fraction", source.wrap->offset},
          {"triangles", source.mesh.triangles.size()},
          {"farthest_from_original_fraction", source.wrap->farthestUpper / diagonal},
          {"farthest_from_original_at_least_fraction", source.wrap->farthestLower / diagonal}};
}

/// CLI11's own ranges let NaN through.
std::function<std::string(const std::string&)> isWithin(double least, double most) {
  return [least, most](const std::string& text) {
    double value = 0;
    const bool within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
    return within ? std::string() : fmt::format("'{}' is not a number from {} to {}", text, least, most);
  };
}

}  // namespace

void addMeshSource(CLI::App& command, MeshSourceOptions& options) {
  command
      .add_option("MESH", options.path,
                  "Triangle mesh: OBJ, OFF, PLY, STL, glTF, ...; closed, unless repaired or wrapped")
      ->required();
  CLI::Option* repair = command.add_flag("--repair", options.repair,
                                         "Stitch borders, drop duplicate triangles, make sides consistent, fill holes "
                                         "and unite bodies first; the certificate is then about the repaired mesh");
  CLI::Option* wrap = command.add_flag("--wrap", options.wrap,
                                       "Build on a closed skin around the mesh, which may be open or cross itself; the "
                                       "certificate is then about the skin, the report adds its distance to the mesh");
  repair->excludes(wrap);
  command
      .add_option("--weld", options.repairOptions.weld,
                  "Gaps between parts of at most this fraction of the diagonal are closed; 0 for none")
      ->check(isWithin(0, builder::kMaxWeld))
      ->needs(repair)
      ->capture_default_str();
  command
      .add_option("--wrap-alpha", options.wrapOptions.alpha,
                  "Openings narrower than about this fraction of the diagonal are closed")
      ->check(isWithin(builder::kMinAlpha, builder::kMaxAlpha))
      ->needs(wrap)
      ->capture_default_str();
  command
      .add_option("--wrap-offset", options.wrapOptions.offset,
                  "About how far outside the mesh the skin lies, as a fraction of the diagonal")
      ->check(isWithin(builder::kMinOffset, builder::kMaxOffset))
      ->needs(wrap)
      ->capture_default_str();
  command
      .add_option(
          "--wrap-error", options.wrapOptions.maxDistance,
          "Make the skin finer until no point of it is farther from the mesh than this fraction of the diagonal")
      ->check(isWithin(builder::kMinWrapDistance, builder::kMaxOffset))
      ->needs(wrap);
  command.add_option("--mesh-output", options.output,
                     "Write the repaired mesh or the skin, for `cairn certify`: a PLY file, which keeps every bit");
}

void checkMeshSource(const MeshSourceOptions& options) {
  if (options.output.empty()) return;
  if (!options.repair && !options.wrap)
    throw CLI::ValidationError("--mesh-output", "without --repair or --wrap the tree is built on MESH itself");
  if (std::filesystem::path(options.output).extension() != ".ply")
    throw CLI::ValidationError("--mesh-output", "the mesh is written as PLY; name a file that ends with .ply");
}

Result<MeshSource> readMeshSource(const MeshSourceOptions& options, const builder::ProgressCallback& progress) {
  builder::ImportCounts counts;
  Result<builder::TriangleMesh> surface = builder::importSurface(options.path, &counts);
  if (!surface) return surface.error();
  if (interrupted()) return Error{std::string(builder::kCancelled)};
  const bool asIs = !options.repair && !options.wrap;
  if (asIs) {
    if (Status s = checkMesh(surface.value(), counts.degenerateTriangles); !s)
      return Error{s.error().message + ", or try --repair or --wrap"};
  }
  if (counts.degenerateTriangles > 0)
    fmt::print(stderr, "cairn: {}: left out {} triangles without area\n", surface.value().name,
               counts.degenerateTriangles);
  if (options.repair) return repaired(surface.value(), options.repairOptions);
  if (options.wrap) return wrapped(surface.value(), options.wrapOptions, progress);
  return MeshSource{std::move(surface).value(), {}, {}, {}};
}

void reportMeshSource(const MeshSource& source, const std::vector<builder::LevelFit>& fits, Json& json) {
  json["certified_mesh"] = source.repair ? "repaired" : source.wrap ? "wrap" : "original";
  if (source.repair) json["repair"] = repairJson(*source.repair, source.repairOptions);
  if (!source.wrap) return;
  json["wrap"] = wrapJson(source);
  for (std::size_t i = 0; i < fits.size(); ++i)
    json["levels"][i]["original_max_fraction"] = originalMaxFraction(source, fits[i]);
}

void printMeshSource(const MeshSource& source, const std::vector<builder::LevelFit>& fits) {
  if (source.repair) fmt::print("Repaired: {}. The certificate is about the repaired mesh.\n", source.repair->text());
  if (!source.wrap) return;
  fmt::print(
      "Wrapped in {} triangles, nowhere farther than {:.4f} % from the original surface (it is {:.4f} %). The "
      "certificate is about the wrap;\nagainst the original surface the certified error is at most",
      source.mesh.triangles.size(), 100 * source.wrap->farthestUpper / boundsOf(source.mesh).diagonal(),
      100 * source.wrap->farthestLower / boundsOf(source.mesh).diagonal());
  for (const builder::LevelFit& fit : fits)
    fmt::print("{} {:.4f} % at level {}", &fit == &fits.front() ? "" : ",", 100 * originalMaxFraction(source, fit),
               fit.level);
  fmt::print(".\n");
}

Status writeMeshOutput(const MeshSource& source, const MeshSourceOptions& options) {
  if (options.output.empty()) return {};
  return writeFileAtomically(options.output, builder::plyBytes(source.mesh));
}

}  // namespace cairn::tool
