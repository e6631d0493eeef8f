// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/ensemble/run_file.h"

#include <LinearMath/btScalar.h>
#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/version.h"
#include "rockfall/case/content_hash.h"
#include "rockfall/ensemble/program_hash.h"
#include "rockfall/ensemble/result_json.h"

namespace cairn::rockfall {
namespace {

constexpr int kFormat = 3;

std::string hashOf(const Json& result) {
  ContentHash hash;
  hash.add(result.dump());
  return hash.hex();
}

}  // namespace

Json versionsOfThisProgram() {
  return {{"cairn", CAIRN_VERSION},
          {"program_sha256", programHash()},
          {"tree_file", kTreeFileVersion},
          {"bullet", btGetVersion()},
          {"scalar_bytes", sizeof(btScalar)}};
}

std::string runFileName(std::uint64_t run) {
  return fmt::format("run-{:09}.json", run);
}

Status writeRunFile(const std::filesystem::path& folder, const std::string& sceneHash, const FinishedRun& run) {
  Json result = resultToJson(run.result);
  const std::string hash = hashOf(result);
  const Json file{{"format", kFormat},   {"scene_hash", sceneHash},      {"versions", versionsOfThisProgram()},
                  {"result_hash", hash}, {"cost", costToJson(run.cost)}, {"result", std::move(result)}};
  return writeFileAtomically(folder / runFileName(run.result.run), file.dump() + "\n");
}

Result<RunFile> readRunFile(const std::filesystem::path& file) {
  const auto content = readFile(file);
  if (!content) return content.error();
  const Error damaged{fmt::format("{} is not a run as it was written: remove it, and run it again", file.string())};
  try {
    const Json json = Json::parse(content.value().begin(), content.value().end());
    if (json.at("format") != kFormat)
      return Error{
          fmt::format("{} has format {}, this version reads {}", file.string(), json.at("format").dump(), kFormat)};
    RunFile run{json.at("scene_hash").get<std::string>(), json.at("versions"), resultFromJson(json.at("result")),
                costFromJson(json.at("cost")), json.at("result_hash").get<std::string>()};
    if (hashOf(json.at("result")) != run.resultHash || runFileName(run.result.run) != file.filename()) return damaged;
    return run;
  } catch (const Json::exception&) {
    return damaged;
  }
}

}  // namespace cairn::rockfall
