// SPDX-License-Identifier: GPL-3.0-or-later
// The published schema and the reader must judge alike. Every example, and every example with one thing changed: each
// value in turn removed, replaced by values of other kinds and beyond ranges, each object given one more key.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cairn/core/atomic_file.h"
#include "case_documents.h"
#include "run_program.h"

namespace cairn::rockfall::schema_test {
namespace {

using nlohmann::json;

json parseExample(const std::filesystem::path& file) {
  return json::parse(test::contentOf(file), nullptr, true, true);
}

/// Pointers to every value in a document, itself left out. Long lists are alike: their first two elements stand for
/// all.
void collectPointers(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& pointers) {
  if (value.is_object())
    for (const auto& [key, member] : value.items()) {
      pointers.push_back(at / key);
      collectPointers(member, at / key, pointers);
    }
  if (value.is_array())
    for (std::size_t i = 0; i < std::min<std::size_t>(value.size(), 2); ++i) {
      pointers.push_back(at / i);
      collectPointers(value[i], at / i, pointers);
    }
}

void addChanged(const json& document, const json::json_pointer& at, std::vector<json>& all) {
  static const std::vector<json> kReplacements{nullptr, true, 0,   -1,        -0.5,          1.5,           1e9,
                                               1e13,    "",   "x", "No name", json::array(), json::object()};
  for (const json& replacement : kReplacements) {
    all.push_back(document);
    all.back()[at] = replacement;
  }
  json& parent = all.emplace_back(document)[at.parent_pointer()];
  if (parent.is_object())
    parent.erase(at.back());
  else
    parent.erase(std::stoul(at.back()));
  if (document[at].is_array() && !document[at].empty()) {
    all.push_back(document);
    all.back()[at].push_back(all.back()[at].front());
  }
  if (document[at].is_object()) {
    all.push_back(document);
    all.back()[at]["one_more"] = 1;
  }
}

std::vector<json> documents() {
  std::vector<json> all{json::array(), json::object(), 3};
  for (const auto& file : test::exampleFiles()) {
    const json document = parseExample(file);
    all.push_back(document);
    std::vector<json::json_pointer> pointers;
    collectPointers(document, json::json_pointer(), pointers);
    for (const auto& pointer : pointers) addChanged(document, pointer, all);
  }
  return all;
}

/// The checks that the schema leaves to the program.
bool isBeyondTheSchema(const std::string& sentence) {
  static constexpr std::array kWords{"is not listed under /materials",
                                     "listed twice",
                                     "must not fall, and shares",
                                     "the first share must be 0",
                                     "of a profile",
                                     "ends of the line",
                                     "must not be below",
                                     "comes first",
                                     "cross: give the corners",
                                     "No such file",
                                     "cannot open"};
  for (const char* words : kWords)
    if (sentence.find(words) != std::string::npos && sentence.find("the effect") == std::string::npos) return true;
  return false;
}

std::vector<std::string> verdictsOfSchema(const std::vector<json>& all) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "schema.json") << caseSchema();
  std::ofstream list(folder.path() / "documents");
  for (const json& document : all) list << document.dump() << '\n';
  list.close();
  const std::string command =
      "/usr/bin/python3 '" CAIRN_ROCKFALL_TESTS "/judge_schema.py' '" + (folder.path() / "schema.json").string() +
      "' '" + (folder.path() / "documents").string() + "' > '" + (folder.path() / "verdicts").string() + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::vector<std::string> verdicts;
  std::istringstream lines(test::contentOf(folder.path() / "verdicts"));
  for (std::string line; std::getline(lines, line);) verdicts.push_back(line);
  return verdicts;
}

TEST(Case_Schema, JudgesAsTheReaderDoes) {
  if (std::system("/usr/bin/python3 -W ignore -c 'import jsonschema' 2> /dev/null") != 0)
    GTEST_SKIP() << "needs Debian's package python3-jsonschema";
  const std::vector<json> all = documents();
  EXPECT_GT(all.size(), 1000U);
  const std::vector<std::string> verdicts = verdictsOfSchema(all);
  ASSERT_EQ(verdicts.size(), all.size());
  std::size_t good = 0, beyond = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto read = test::readJson(all[i]);
    good += read.ok();
    if (!read && verdicts[i] == "good" && isBeyondTheSchema(read.error().message)) {
      ++beyond;
      continue;
    }
    EXPECT_EQ(verdicts[i], read ? "good" : "bad") << all[i].dump() << (read ? "" : "\n" + read.error().message);
    if (HasFailure()) break;  // one document to look at is enough
  }
  EXPECT_GT(good, 100U) << "changes within the ranges are among them";
  std::printf("%zu documents judged alike, %zu of them good, %zu refused beyond the schema\n", all.size(), good,
              beyond);
}

TEST(Case_Schema, IsThePublishedFile) {
  EXPECT_EQ(caseSchema(), test::contentOf(CAIRN_ROCKFALL_SCHEMA));
}

}  // namespace
}  // namespace cairn::rockfall::schema_test
