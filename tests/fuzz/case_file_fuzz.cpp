// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feeds the reader of rock-fall's case files. What it refuses it refuses in one sentence that names the file and the
// place; what it accepts can be used, and is the same case when it is written down again.
#include <algorithm>
#include <cmath>
#include <string>

#include "require.h"
#include "rockfall/case/case.h"

namespace {

using namespace cairn;
using fuzz::require;

const std::string kFile = "case.json";

/// "case.json: /rocks/0/count: ...", or "case.json: this is not JSON: ..." with line and column.
void requirePlace(const std::string& message) {
  fuzz::requireSentence(message);
  require(message.starts_with(kFile + ": "), "a refusal does not name the file: '" + message + "'");
  const std::string rest = message.substr(kFile.size() + 2);
  const bool hasPath = rest.starts_with("/") || rest.starts_with("(top)");
  require(hasPath || rest.starts_with("this is not JSON: "), "a refusal names no place: '" + message + "'");
}

void use(const rockfall::Case& scene) {
  require(!scene.name.empty() && scene.hash.size() == 64, "a case has no name or no hash");
  require(scene.stepCount() >= 1 && scene.stepCount() <= 100000000, "a case has no steps, or too many");
  require(!scene.materials.empty() && !scene.rocks.empty(), "a case has no materials or no rocks");
  for (const double x : {-1e7, -1.0, 0.0, 0.5, 30.0, 1e7})
    require(scene.terrain.materialAt({x, x / 2}) < scene.materials.size(), "the ground is of a material not listed");
  for (const rockfall::RockGroup& group : scene.rocks) {
    require(group.material < scene.materials.size(), "a rock is of a material not listed");
    for (const double share : {0.0, 1e-9, 0.3, 0.5, 1.0}) {
      const double size = group.sieve.sizeAt(share);
      require(size >= group.sieve.smallest() * (1 - 1e-12) && size <= group.sieve.largest() * (1 + 1e-12),
              "a rock is larger or smaller than its sieve");
    }
  }
  for (const rockfall::EffectOptions& effect : scene.effects)
    require(!rockfall::nameOf(effect).empty(), "an effect has no name");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto scene = rockfall::parseCase(text, kFile, CAIRN_ROCKFALL_EXAMPLES);
  if (!scene) {
    requirePlace(scene.error().message);
    return 0;
  }
  use(scene.value());
  const std::string again = rockfall::parseDocument(text, kFile).value().dump(1);
  const auto same = rockfall::parseCase(again, kFile, CAIRN_ROCKFALL_EXAMPLES);
  require(same.ok() && same.value().hash == scene.value().hash, "a case that is written down again is another");
  return 0;
}
