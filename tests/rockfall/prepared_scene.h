// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "case_documents.h"
#include "rockfall/simulation/scene.h"
#include "run_program.h"

namespace cairn::test {

/// Trees that the tests of one process share.
inline std::filesystem::path treeFolder() {
  static const TemporaryFolder folder;
  return folder.path();
}

inline rockfall::Scene prepared(const nlohmann::json& document) {
  rockfall::TreeCache cache(treeFolder());
  auto description = readJson(document);
  EXPECT_TRUE(description) << description.error().message;
  auto scene = rockfall::prepareScene(std::move(description).value(), cache);
  EXPECT_TRUE(scene) << scene.error().message;
  return std::move(scene).value();
}

}  // namespace cairn::test
