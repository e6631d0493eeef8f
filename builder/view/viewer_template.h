// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

namespace cairn::builder {

/// The page without its data, in pieces that follow each other: pieces are short because compilers limit the length of
/// a literal. Empty in a build without the viewer. page/bundle.mjs generates the source that defines it.
std::span<const std::string_view> viewerTemplate();

/// The place of the title in the template.
inline constexpr std::string_view kTitlePlace = "{{cairn-title}}";
/// The place of the data in the template.
inline constexpr std::string_view kScenePlace = "{{cairn-scene}}";

}  // namespace cairn::builder
