// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "rockfall/simulation/run_result.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// The tables of an ensemble as CSV with a header line. They grow run by run in memory (about 150 bytes a line).
class Tables {
 public:
  explicit Tables(const Case& description);
  /// Adds a run. Call it in ascending order of runs.
  void add(const RunResult& result);

  const std::string& runs() const { return runs_; }
  const std::string& rocks() const { return rocks_; }
  const std::string& impacts() const { return impacts_; }
  const std::string& crossings() const { return crossings_; }
  const std::string& effects() const { return effects_; }

 private:
  const Case& description_;
  std::string runs_, rocks_, impacts_, crossings_, effects_;
};

/// resting, moving, left, lost, broken or hole.
const char* nameOf(RockEnd ending);

}  // namespace cairn::rockfall
