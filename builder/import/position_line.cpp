// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/position_line.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

namespace cairn::builder {

Result<Vec3d> readPosition(LineReader& line) {
  Vec3d point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = line.nextWord();
    const std::optional<double> value = parseNumber<double>(word);
    if (word.empty())
      return line.error("a vertex needs three coordinates on its line; the file may be truncated, export it again");
    if (!value) return line.error(fmt::format("'{}' is not a coordinate; correct the line or export again", word));
    if (!std::isfinite(static_cast<float>(*value)))
      return line.error(
          fmt::format("the coordinate {} is not finite in single precision; remove the vertex or rescale "
                      "the mesh",
                      word));
    point[axis] = *value;
  }
  return point;
}

}  // namespace cairn::builder
