// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "../table/hard_case.h"
#include "cairn/builder/build.h"
#include "cairn/builder/triangle_mesh.h"

namespace cairn::hard {

/// The demands of the whole family on every mesh, besides a case's own criterion: an answer within a stated time, which
/// is a certified tree or one sentence that names what is wrong; no number that is not finite; the surface inside the
/// balls all the way up; the same bytes when built again, on one thread. (A crash ends the table.)
class FamilyDemands {
 public:
  /// `seconds`: what one answer may take, an import, a build or a refusal.
  FamilyDemands(Effort effort, double seconds) : effort_(effort), seconds_(seconds) {}

  /// `combined`, 72 leaves of 1000 pieces (quick) or 584 of 5000.
  builder::BuildOptions options() const;

  /// Builds twice, certifies and looks for surface points outside. The tree; nothing, and a demand missed, if it was
  /// refused.
  std::optional<SphereTree> build(const builder::TriangleMesh& mesh) { return build(mesh, options()); }
  std::optional<SphereTree> build(const builder::TriangleMesh& mesh, const builder::BuildOptions& options);

  /// Writes a file into a folder of its own and imports it: as a solid, or as a surface for `repair` and `wrap`.
  Result<builder::TriangleMesh> import(const std::string& name, const std::string& bytes);
  Result<builder::TriangleMesh> importSurface(const std::string& name, const std::string& bytes);

  /// Whether something is refused by one sentence that holds `named`. What is not is counted, and told by `addTo`.
  template <class T>
  bool refuses(const Result<T>& result, std::string_view named) {
    return result ? refused(nullptr, named) : refused(&result.error(), named);
  }
  bool refuses(const Status& status, std::string_view named) {
    return status ? refused(nullptr, named) : refused(&status.error(), named);
  }
  /// The value; nothing, and a demand missed, if it was refused.
  template <class T>
  std::optional<T> accepted(Result<T> result) {
    if (result) return std::move(result).value();
    tell(result.error().message);
    return {};
  }

  /// Appends the family's measures, and, where one was missed, the first sentence that says so.
  void addTo(Outcome& outcome) const;

 private:
  using Clock = std::chrono::steady_clock;
  bool refused(const Error* error, std::string_view named);
  void tell(const std::string& wrong);
  void noteTime(Clock::time_point start);
  void examine(const SphereTree& tree, const builder::TriangleMesh& mesh);

  Effort effort_;
  double seconds_, slowest_ = 0;
  std::uint64_t trees_ = 0, points_ = 0, refusals_ = 0;
  std::uint64_t notFinite_ = 0, otherBytes_ = 0, unproved_ = 0, outside_ = 0, wrongAnswers_ = 0;
  std::string firstWrong_;
};

}  // namespace cairn::hard
