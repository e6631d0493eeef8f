// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/runs/run.h"

#include <chrono>
#include <optional>
#include <utility>

#include "accuracy_cost/figures/draw.h"
#include "accuracy_cost/runs/seal.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/version.h"

namespace cairn::accuracy_cost {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Result<std::string> textOf(const fs::path& path) {
  const auto bytes = readFile(path);
  if (!bytes) return bytes.error();
  return std::string(reinterpret_cast<const char*>(bytes.value().data()), bytes.value().size());
}

/// Everything that a table depends on, beside the program.
Json settingsJson(const RunPlan& plan, const std::vector<Model>& models) {
  Json meshes = Json::object();
  for (const Model& model : models) meshes[model.name] = model.mesh.sha256;
  return {{"quick", plan.settings.quick}, {"seed", plan.settings.seed}, {"version", CAIRN_VERSION}, {"meshes", meshes}};
}

Json modelsJson(const std::vector<Model>& models) {
  Json list = Json::array();
  for (const Model& model : models)
    list.push_back({{"name", model.name}, {"triangles", model.mesh.triangles.size()}, {"sha256", model.mesh.sha256}});
  return list;
}

Json claimsJson(const std::vector<Claim>& claims) {
  Json list = Json::array();
  for (const Claim& claim : claims)
    list.push_back({{"thesis", claim.thesis},
                    {"rule", claim.rule},
                    {"found", claim.found},
                    {"holds", claim.holds},
                    {"standing", standingName(standingOf(claim))},
                    {"own", claim.isOwn},
                    {"figure", claim.figure ? Json(*claim.figure) : Json()},
                    {"lacking", claim.lacking},
                    {"lacking_settings", claim.scope.lackingSettings},
                    {"lacking_text", lackingText(claim)}});
  return list;
}

/// Returns the finished document of the same settings, if it and its table exist unchanged.
std::optional<Json> kept(const fs::path& file, const fs::path& csv, const Json& settings) {
  const auto text = textOf(file);
  if (!text) return std::nullopt;
  Json document = Json::parse(text.value(), nullptr, false);
  if (!isSealed(document) || document["settings"] != settings) return std::nullopt;
  if (!areWhole({csv.filename().string()}, document["files"], csv.parent_path())) return std::nullopt;
  return document;
}

/// True when figures exist and all of them are unchanged since they were drawn.
bool hasFigures(const Json& document, const fs::path& folder) {
  const auto names = document["figures"].get<std::vector<std::string>>();
  return !names.empty() && areWhole(names, document["files"], folder);
}

Json documentOf(const RunPlan& plan, const std::vector<Model>& models, const std::vector<std::string>& leftOut,
                const Table& table, double seconds) {
  const Experiment& e = *plan.experiment;
  const std::vector<Claim> claims = claimsOf(e, table);
  return {{"experiment", e.name},
          {"title", e.title},
          {"thesis_section", e.section},
          {"thesis_says", e.says},
          {"we_found", foundText(claims)},
          {"verdict", verdictName(verdictOf(claims), e.isOwn)},
          {"why", whyText(claims)},
          {"differs", e.differs},
          {"rule", kVerdictRule},
          {"claims", claimsJson(claims)},
          {"command", plan.command},
          {"csv", std::string(e.name) + ".csv"},
          {"figures", Json::array()},
          {"models", modelsJson(models)},
          {"default_models", e.models},
          {"own", e.isOwn},
          {"left_out", leftOut},
          {"settings", settingsJson(plan, models)},
          {"seconds", seconds},
          {"files", digestsOf({std::string(e.name) + ".csv"}, plan.folder)}};
}

Status addFigures(Json& document, const RunPlan& plan, const Table& table, const fs::path& csv) {
  std::vector<std::string> names;
  for (const Figure& figure : plan.experiment->draw(table)) {
    const auto files = drawFigure(figure, table, csv, plan.folder);
    if (!files) return files.error();
    names.insert(names.end(), files.value().begin(), files.value().end());
  }
  document["files"].update(digestsOf(names, plan.folder));
  document["figures"] = std::move(names);
  return {};
}

Result<Table> tableIn(const fs::path& csv) {
  const auto text = textOf(csv);
  if (!text) return text.error();
  return Table::parse(text.value());
}

/// Measures and writes the table; the document still lacks its figures.
Result<Table> measured(const RunPlan& plan, const std::vector<Model>& models, const fs::path& csv, RunReport& report,
                       const builder::ProgressCallback& progress) {
  const auto begin = std::chrono::steady_clock::now();
  auto table = plan.experiment->measure(models, plan.settings, progress);
  if (!table) return table.error();
  if (Status written = writeFileAtomically(csv, table.value().csv()); !written) return written.error();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  report.measured = true;
  report.document = documentOf(plan, models, report.leftOut, table.value(), seconds.count());
  return table;
}

}  // namespace

Result<RunReport> runExperiment(const RunPlan& plan, const builder::ProgressCallback& progress) {
  if (plan.figures)
    if (Status there = checkGnuplot(); !there) return there.error();
  const fs::path csv = plan.folder / (std::string(plan.experiment->name) + ".csv");
  const fs::path json = plan.folder / (std::string(plan.experiment->name) + ".json");
  RunReport report;
  const auto& names = plan.settings.quick ? plan.experiment->quickModels : plan.experiment->models;
  const auto models = readModels(names, plan.models, report.leftOut, progress);
  if (!models) return models.error();
  if (auto document = kept(json, csv, settingsJson(plan, models.value()))) {
    report.document = std::move(*document);
    if (!plan.figures || hasFigures(report.document, plan.folder)) return report;
  }
  const auto table = report.document.is_null() ? measured(plan, models.value(), csv, report, progress) : tableIn(csv);
  if (!table) return table.error();
  if (plan.figures)
    if (Status drawn = addFigures(report.document, plan, table.value(), csv); !drawn) return drawn.error();
  report.document = sealed(std::move(report.document));
  if (Status written = writeFileAtomically(json, report.document.dump(1) + "\n"); !written) return written.error();
  return report;
}

}  // namespace cairn::accuracy_cost
