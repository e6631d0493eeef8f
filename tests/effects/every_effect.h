// SPDX-License-Identifier: Zlib
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "cairn/effects/effect_set.h"
#include "cairn/effects/ground_height.h"
#include "effect_materials.h"

namespace cairn::test {

/// Ground that rises by `kRise` along x, some way above the origin.
class Incline final : public effects::GroundHeight {
 public:
  static constexpr btScalar kRise = btScalar(0.3);
  explicit Incline(btScalar above = 0) : above_(above) {}
  std::optional<btScalar> at(btScalar x, btScalar /*y*/) const override { return kRise * x + above_; }

 private:
  btScalar above_;
};

/// An effect, set so that it acts in `rockSlope`; so that it has no strength, or none that anything could meet, by each
/// parameter that takes it; so that it never meets what it acts on, empty where it always does.
struct EffectRow {
  using Make = std::function<std::unique_ptr<effects::Effect>()>;

  std::string name;
  Make active;
  std::map<std::string, Make> zeros;  // by parameter
  Make idle;
  bool changesMotion = true;  // when it acts
  bool dissipates = true;     // or keeps; never gives energy
};
inline void PrintTo(const EffectRow& row, std::ostream* out) {
  *out << row.name;
}

/// A row for each effect of the library.
std::vector<EffectRow> everyEffect();

}  // namespace cairn::test
