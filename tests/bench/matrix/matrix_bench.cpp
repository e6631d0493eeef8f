// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sphere-trees against everything Bullet has to lie on or to set down: how they rest, slide and roll, beside Bullet's
// own shapes on the same, and mechanics. The trees are the builder's, of generated solids.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/core/atomic_file.h"
#include "collider_trials.h"

namespace cairn::bench {
namespace {

using nlohmann::ordered_json;
using test::Trials;
using test::TriedGround;
using test::TriedMover;

constexpr double kMillimetres = 1000;

std::shared_ptr<const SphereTree> builtTree(const test::Solid& solid) {
  builder::TriangleMesh mesh = test::meshOf(solid);
  mesh.name = "generated";
  auto built = builder::buildTree(mesh, {});
  if (!built) throw std::runtime_error(built.error().message);
  return std::make_shared<const SphereTree>(std::move(built).value());
}

/// One pair, and the stock pair it is judged by.
struct Pairing {
  std::string name;
  const TriedGround& ground;
  const TriedMover& mover;
  const TriedGround& stockGround;
  const TriedMover& stockMover;
};

std::string touchingText(const test::Touching& touching) {
  return fmt::format("{:3}{:7.2f}", touching.contacts, kMillimetres * touching.penetration);
}

class Table {
 public:
  void rest(const Pairing& p) {
    const double theory = Trials::restTheory(p.ground, p.mover);
    for (const bool bodyFirst : {false, true}) {
      const test::RestRun ours = Trials::rest(p.ground, p.mover, bodyFirst);
      const test::RestRun stock = Trials::rest(p.stockGround, p.stockMover, bodyFirst);
      print("rests", p, bodyFirst,
            fmt::format("{:8.2f}{:9.2f}{:9.2f}", kMillimetres * theory, kMillimetres * ours.height,
                        kMillimetres * stock.height),
            ours.touching, stock.touching);
      ordered_json row = rowOf("rest", p, bodyFirst, ours.touching, stock.touching);
      row["height_m"] = {{"theory", theory}, {"tree", ours.height}, {"stock", stock.height}};
      row["speed_m_s"] = {{"theory", 0}, {"tree", ours.speed}, {"stock", stock.speed}};
      rows_.push_back(std::move(row));
    }
  }
  void slide(const Pairing& p) {
    goDown("slides", p, Trials::slideTheory(p.ground, p.mover), Trials::slideTheory(p.stockGround, p.stockMover),
           Trials::slide);
  }
  void roll(const Pairing& p) {
    goDown("rolls", p, Trials::rollTheory(p.ground, p.mover), Trials::rollTheory(p.stockGround, p.stockMover),
           Trials::roll);
  }
  static void title(const std::string& what) {
    fmt::print("\n{}\n{:58}{:>8}{:>9}{:>9}    {:>10}    {:>10}\n{:58}{:>8}{:>9}{:>9}    {:>10}    {:>10}\n", what, "",
               "theory", "tree", "stock", "tree", "stock", "", "", "", "", "contacts mm", "contacts mm");
  }
  const ordered_json& json() const { return rows_; }

 private:
  void goDown(const char* what, const Pairing& p, double theory, double stockTheory, const auto& run) {
    for (const bool bodyFirst : {false, true}) {
      const test::SlopeRun ours = run(p.ground, p.mover, bodyFirst);
      const test::SlopeRun stock = run(p.stockGround, p.stockMover, bodyFirst);
      const double off = 100 * (ours.acceleration / theory - 1);
      const double stockOff = 100 * (stock.acceleration / stockTheory - 1);
      print(what, p, bodyFirst, fmt::format("{:8.3f}{:+8.1f}%{:+8.1f}%", theory, off, stockOff), ours.touching,
            stock.touching);
      ordered_json row = rowOf(what, p, bodyFirst, ours.touching, stock.touching);
      row["acceleration_m_s2"] = {{"theory", theory}, {"tree", ours.acceleration}};
      row["off_percent"] = {{"tree", off}, {"stock", stockOff}};
      rows_.push_back(std::move(row));
    }
  }
  static void print(const char* what, const Pairing& p, bool bodyFirst, const std::string& values,
                    const test::Touching& ours, const test::Touching& stock) {
    fmt::print("{:58}{}    {}    {}\n",
               fmt::format("{} {}{}", p.name, what, bodyFirst ? ", added before the ground" : ""), values,
               touchingText(ours), touchingText(stock));
    std::fflush(stdout);
  }
  static ordered_json rowOf(const char* what, const Pairing& p, bool bodyFirst, const test::Touching& ours,
                            const test::Touching& stock) {
    return {{"pair", p.name},
            {"trial", what},
            {"body_first", bodyFirst},
            {"contacts", {{"tree", ours.contacts}, {"stock", stock.contacts}}},
            {"penetration_m", {{"tree", ours.penetration}, {"stock", stock.penetration}}}};
  }

  ordered_json rows_ = ordered_json::array();
};

void treesOnEverything(Table& table) {
  Table::title("A tree's block and ball on every ground; stock: a box and a sphere on the same. mm; m/s2 and % off.");
  const TriedMover block = test::treeBlock(builtTree), ball = test::treeBall(builtTree);
  const TriedMover box = test::boxBlock(), sphere = test::sphereBall();
  for (const TriedGround& ground : test::everyGround(builtTree)) {
    const Pairing blocks{"block on " + ground.name, ground, block, ground, box};
    table.rest(blocks);
    table.slide(blocks);
    table.roll({"ball on " + ground.name, ground, ball, ground, sphere});
  }
}

void everythingOnATree(Table& table) {
  Table::title("Everything on a tree's slab; stock: the same on a box, and a box or a sphere in a tree's place.");
  const std::vector<TriedGround> grounds = test::everyGround(builtTree);
  const auto isTree = [](const auto& tried) { return tried.name == "tree"; };
  const TriedGround& slab = *std::ranges::find_if(grounds, isTree);
  const TriedGround stockGround = test::boxGround();
  const TriedMover box = test::boxBlock(), sphere = test::sphereBall();
  for (const TriedMover& mover : test::everyMover(builtTree)) {
    const bool isOurs = mover.name.find("tree") != std::string::npos;
    const TriedMover& stock = !isOurs ? mover : mover.radius > 0 ? sphere : box;
    const Pairing pairing{mover.name + " on a tree", slab, mover, stockGround, stock};
    table.rest(pairing);
    if (mover.radius > 0)
      table.roll(pairing);
    else
      table.slide(pairing);
  }
}

Status measure(const std::string& json) {
  Table table;
  treesOnEverything(table);
  everythingOnATree(table);
  return json.empty() ? Status() : writeFileAtomically(json, table.json().dump(2) + "\n");
}

}  // namespace
}  // namespace cairn::bench

int main(int argc, char** argv) {
  std::string json;
  CLI::App app("How sphere-trees rest, slide and roll with everything of Bullet's, beside its own shapes.",
               "matrix_bench");
  app.add_option("--json", json, "write the figures to this file");
  CLI11_PARSE(app, argc, argv);
  const cairn::Status status = cairn::bench::measure(json);
  if (status) return 0;
  fmt::print(stderr, "matrix_bench: {}\n", status.error().message);
  return 1;
}
