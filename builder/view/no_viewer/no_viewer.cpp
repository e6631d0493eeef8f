// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stands in for the generated source where node or npm is missing.
#include "view/viewer_template.h"

namespace cairn::builder {

std::span<const std::string_view> viewerTemplate() {
  return {};
}

}  // namespace cairn::builder
