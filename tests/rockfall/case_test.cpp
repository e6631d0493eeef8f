// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/case.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "case_documents.h"
#include "random_tree.h"
#include "run_program.h"

namespace cairn::rockfall::case_test {
namespace {

using nlohmann::json;

TEST(Case_Examples, AreAllRead) {
  const auto files = test::exampleFiles();
  EXPECT_GE(files.size(), 5U);
  for (const auto& file : files) {
    const auto scene = readCase(file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_FALSE(scene.value().effects.empty()) << file;
    EXPECT_EQ(scene.value().hash.size(), 64U);
  }
}

TEST(Case_Examples, NameEveryEffectTogether) {
  std::set<std::size_t> kinds;
  for (const auto& file : test::exampleFiles()) {
    const Case scene = readCase(file).value();
    for (const EffectOptions& effect : scene.effects) kinds.insert(effect.index());
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<EffectOptions>);
}

TEST(Case_Read, KeepsWhatTheFileSays) {
  const auto read = test::readJson(test::plainCase());
  ASSERT_TRUE(read) << read.error().message;
  const Case& scene = read.value();
  EXPECT_EQ(scene.name, "plain");
  EXPECT_EQ(scene.stepCount(), 400U);
  EXPECT_EQ(scene.gravityMPerS2, 9.81);
  EXPECT_EQ(scene.budget.operations, 20000U);
  EXPECT_EQ(scene.terrain.materialAt({39, 0}), 0U) << "in the zone";
  EXPECT_EQ(scene.terrain.materialAt({10, 0}), 1U);
  const auto* friction = findEffect<FrictionOptions>(scene.effects);
  ASSERT_NE(friction, nullptr);
  EXPECT_EQ(friction->coefficient.at(1, 0), (Span{0.6, 0.6})) << "in either order";
  EXPECT_EQ(friction->coefficient.at(0, 0), (Span{0.5, 0.5}));
  EXPECT_EQ(findEffect<WaterOptions>(scene.effects), nullptr);
}

TEST(Case_SieveCurve, IsStraightBetweenItsPoints) {
  const SieveCurve curve{{{0.4, 0}, {0.7, 0.5}, {1.1, 1}}};
  EXPECT_DOUBLE_EQ(curve.sizeAt(0), 0.4);
  EXPECT_DOUBLE_EQ(curve.sizeAt(0.25), 0.55);
  EXPECT_DOUBLE_EQ(curve.sizeAt(0.5), 0.7);
  EXPECT_DOUBLE_EQ(curve.sizeAt(0.75), 0.9);
  EXPECT_DOUBLE_EQ(curve.sizeAt(1), 1.1);
}

TEST(Case_Hash, SeesTheContentAndNotTheComments) {
  const std::string text = test::plainCase().dump(1);
  const auto hashOf = [](const std::string& content) { return parseCase(content, "case.json", ".").value().hash; };
  const std::string hash = hashOf(text);
  EXPECT_EQ(hashOf("// a remark\n" + text), hash);
  json other = test::plainCase();
  other["seed"] = 2;
  EXPECT_NE(hashOf(other.dump()), hash);
}

TEST(Case_Hash, SeesTheFilesTheCaseNames) {
  const test::TemporaryFolder folder;
  json document = test::plainCase();
  document["rocks"][0].erase("make");
  document["rocks"][0]["mesh"] = "rock.obj";
  const auto missing = parseCase(document.dump(), "case.json", folder.path());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message.rfind("case.json: /rocks/0/mesh: ", 0), 0U) << missing.error().message;
  std::ofstream(folder.path() / "rock.obj") << "v 0 0 0\n";
  const std::string first = parseCase(document.dump(), "case.json", folder.path()).value().hash;
  std::ofstream(folder.path() / "rock.obj") << "v 0 0 1\n";
  EXPECT_NE(parseCase(document.dump(), "case.json", folder.path()).value().hash, first);
}

/// A change of the plain case, as a JSON patch, and the sentence it is refused with.
struct Slip {
  const char* patch;
  const char* sentence;

  friend std::ostream& operator<<(std::ostream& out, const Slip& slip) { return out << slip.patch; }
};

class CaseSlips : public ::testing::TestWithParam<Slip> {};

TEST_P(CaseSlips, AreRefusedInOneSentenceWithThePath) {
  const auto read = test::readJson(test::plainCase().patch(json::parse(GetParam().patch)));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, GetParam().sentence);
}
INSTANTIATE_TEST_SUITE_P(
    Each, CaseSlips,
    ::testing::Values(
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "air_drag", "coefficent": 1}}])",
             R"(case.json: /effects/1/coefficent: no such key here (did you mean "coefficient"?))"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "fricton", "default": 1}}])",
             "case.json: /effects/1/effect: there is no effect \"fricton\" (did you mean \"friction\"?): use friction, "
             "rolling_resistance, restitution, tangential_restitution, slip_friction, surface_roughness, gyroscopic, "
             "ccd, sleeping, air_drag, water, forest_drag, trees, barrier, soil_scarring, ground_drag, fragmentation, "
             "events"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "water"}}])",
             R"(case.json: /effects/1: "level_m" is missing)"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "water", "level_cm": 50}}])",
             R"(case.json: /effects/1/level_cm: no such key here: give it as "level_m", the unit is in the name)"},
        Slip{R"([{"op": "move", "from": "/step_s", "path": "/step_ms"}])",
             R"(case.json: /step_ms: no such key here: give it as "step_s", the unit is in the name)"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "friction", "default": 1}}])",
             R"(case.json: /effects/1: the effect "friction" is listed twice)"},
        Slip{R"([{"op": "replace", "path": "/step_s", "value": 0}])",
             "case.json: /step_s: 0 is out of range: this must be from 1e-05 to 0.1"},
        Slip{R"([{"op": "replace", "path": "/duration_s", "value": -1}])",
             "case.json: /duration_s: -1 is out of range: this must be above 0 and at most 86400"},
        Slip{R"([{"op": "replace", "path": "/seed", "value": -3}])",
             "case.json: /seed: -3 is out of range: this must be from 0 to 9007199254740992"},
        Slip{R"([{"op": "replace", "path": "/seed", "value": 1.5}])", "case.json: /seed: this must be a whole number"},
        Slip{R"([{"op": "replace", "path": "/step_s", "value": "0.01"}])", "case.json: /step_s: this must be a number"},
        Slip{R"([{"op": "replace", "path": "/rocks/0/make/concave", "value": 1}])",
             "case.json: /rocks/0/make/concave: this must be true or false"},
        Slip{R"([{"op": "replace", "path": "/terrain", "value": []}])",
             "case.json: /terrain: this must be an object, as in { ... }"},
        Slip{R"([{"op": "add", "path": "/terrain/raster", "value": "dem.tif"}])",
             "case.json: /terrain: exactly one of \"generated\", \"raster\" and \"mesh\" must be given"},
        Slip{
            R"([{"op": "replace", "path": "/rocks/0/material", "value": "ston"}])",
            R"(case.json: /rocks/0/material: the material "ston" is not listed under /materials (did you mean "stone"?))"},
        Slip{R"([{"op": "add", "path": "/materials/-", "value": "soil"}])",
             R"(case.json: /materials/2: the material "soil" is listed twice)"},
        Slip{R"([{"op": "add", "path": "/materials/-", "value": "Wet Soil"}])",
             "case.json: /materials/2: a name is made of at most 64 lower-case letters, digits, - and _, and begins "
             "with a letter or digit"},
        Slip{R"([{"op": "add", "path": "/effects/0/pairs/-", "value": {"materials": ["soil", "stone"], "value": 1}}])",
             "case.json: /effects/0/pairs/1: this pair of materials is listed twice"},
        Slip{R"([{"op": "replace", "path": "/rocks/0/sieve_m/sizes", "value": [[0.4, 0], [0.8, 0.9]]}])",
             "case.json: /rocks/0/sieve_m/sizes: the first share must be 0 and the last 1"},
        Slip{R"([{"op": "replace", "path": "/rocks/0/sieve_m/sizes", "value": [[0.8, 0], [0.4, 1]]}])",
             "case.json: /rocks/0/sieve_m/sizes/1: sieve sizes must not fall, and shares must rise, from point to "
             "point"},
        Slip{R"([{"op": "replace", "path": "/collectors/0/line_m", "value": [[1, 2]]}])",
             "case.json: /collectors/0/line_m: this list must have at least 2 elements"},
        Slip{R"([{"op": "add", "path": "/outputs/geotiff", "value": "yes"}])",
             "case.json: /outputs/geotiff: this must be true or false"},
        Slip{R"([{"op": "replace", "path": "/outputs", "value": {"geotiff": true}}])",
             "case.json: /outputs: \"raster_cell_m\" is missing"},
        Slip{R"([{"op": "add", "path": "/two\nlines", "value": 1}])", R"(case.json: /two\nlines: no such key here)"},
        Slip{
            R"([{"op": "replace", "path": "/rocks/0/make/kind", "value": "pebble\u0007\n"}])",
            R"(case.json: /rocks/0/make/kind: there is no kind of rock "pebble\u0007\n": use angular, slabby, rounded)"},
        Slip{R"([{"op": "replace", "path": "/rocks/0/density_kg_per_m3", "value": 2.7}])",
             "case.json: /rocks/0/density_kg_per_m3: 2.7 kg/m3 is lighter than any rock: if these are t/m3, give 2700"},
        Slip{
            R"([{"op": "add", "path": "/effects/-", "value": {"effect": "trees", "stems": [[1, 2, 28]]}}])",
            "case.json: /effects/1/stems/0/2: no stem is 28 m thick: give its diameter at breast height in metres, not "
            "its height, nor centimetres"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value":
                  {"effect": "trees", "stems": {"density_per_ha": 300, "diameter_m": [0.2, 30]}}}])",
             "case.json: /effects/1/stems/diameter_m/1: no stem is 30 m thick: give its diameter at breast height in "
             "metres, not its height, nor centimetres"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "trees", "stems":
                  {"density_per_ha": 300, "diameter_m": [0.2, 0.3], "height_m": [25, 20]}}}])",
             "case.json: /effects/1/stems/height_m: the smaller number comes first"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "trees", "stems": [[1, 2, 0.3, 300]]}}])",
             "case.json: /effects/1/stems/0/3: 300 is out of range: this must be above 0 and at most 130"},
        Slip{R"([{"op": "replace", "path": "/terrain/zones/0/polygon_m", "value": [[0, 0], [4, 4], [4, 0], [0, 4]]}])",
             "case.json: /terrain/zones/0/polygon_m: the edges from corner 0 and from corner 2 cross: give the corners "
             "in order around the area, and two areas as two polygons"},
        Slip{R"([{"op": "replace", "path": "/terrain/zones/0/polygon_m", "value": [[40, -5], [40, 3], [40, 5]]}])",
             "case.json: /terrain/zones/0/polygon_m: its corners lie on one line, so that it has no area"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value":
                  {"effect": "forest_drag", "height_m": 5, "coefficient_kg_per_s": 1,
                   "polygon_m": [[4, 4], [4, 4], [4, 4]]}}])",
             "case.json: /effects/1/polygon_m: its corners lie on one line, so that it has no area"},
        Slip{R"([{"op": "add", "path": "/effects/-", "value": {"effect": "events"}}])",
             "case.json: /effects/1: \"dust_impulse_n_s\" or \"sound_impulse_n_s\" must be given"}));

TEST(Case_Text, ThatIsNoJsonIsRefusedWithItsLine) {
  const auto read = parseCase("{\n  \"case\": \"x\",\n  oops\n}", "case.json", ".");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message.rfind("case.json: this is not JSON: parse error at line 3", 0), 0U)
      << read.error().message;
}

TEST(Case_Text, WithANumberThatIsTooLargeIsRefusedWithItsPath) {
  const auto read = parseCase(R"({"rocks": [{"count": 1}, {"box": [[1, 2], [3, 1e400]]}]})", "case.json", ".");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "case.json: /rocks/1/box/1/1: number overflow parsing '1e400'");
}

TEST(Case_Text, WithAKeyTwiceIsRefusedWithItsPath) {
  const auto read = parseCase(R"({"rocks": [{}, {"count": 1, "a/b": {"count": 1}, "count": 2}]})", "case.json", ".");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "case.json: /rocks/1/count: this key is given twice");
}

TEST(Case_Text, IsToldInOneLineWhateverIsInIt) {
  const auto twice = parseCase(R"({"two\nlines": 1, "two\nlines": 2})", "case.json", ".");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().message, R"(case.json: /two\nlines: this key is given twice)");
  json document = test::plainCase();
  document["rocks"][0].erase("make");
  document["rocks"][0]["mesh"] = "no such\nrock.obj";
  const auto missing = test::readJson(document);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message.find('\n'), std::string::npos) << missing.error().message;
}

TEST(Case_Polygon, ContainsWhatIsInsideOnly) {
  const Polygon corner{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  EXPECT_TRUE(contains(corner, {0.5, 3}));
  EXPECT_TRUE(contains(corner, {3, 0.5}));
  EXPECT_FALSE(contains(corner, {3, 3}));
  EXPECT_FALSE(contains(corner, {-0.1, 0.5}));
  EXPECT_TRUE(contains({}, {1e6, -1e6})) << "no polygon: everywhere";
}

// Against the slow way: every two edges that do not share a corner, as lines with two unknowns.
TEST(Case_Polygon, KnowsWhetherItCrossesItself) {
  EXPECT_FALSE(crossingEdges({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}));
  EXPECT_EQ(crossingEdges({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), (std::pair<std::size_t, std::size_t>{0, 2}));
  EXPECT_FALSE(crossingEdges({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}})) << "it touches itself";
  constexpr std::uint64_t kSeed = 72;
  std::mt19937_64 engine(kSeed);
  int crossing = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Polygon polygon(3 + engine() % 4);
    for (MapPoint& corner : polygon) corner = {test::uniform(engine, 0, 1), test::uniform(engine, 0, 1)};
    bool expected = false;
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j || (i + 1) % n == j || (j + 1) % n == i) continue;
        const MapPoint &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[j], &d = polygon[(j + 1) % n];
        const double ux = b[0] - a[0], uy = b[1] - a[1], vx = d[0] - c[0], vy = d[1] - c[1];
        const double det = uy * vx - ux * vy, x = c[0] - a[0], y = c[1] - a[1];
        const double s = (y * vx - x * vy) / det, t = (ux * y - uy * x) / det;
        expected |= s > 0 && s < 1 && t > 0 && t < 1;
      }
    ASSERT_EQ(crossingEdges(polygon).has_value(), expected) << "seed " << kSeed << ", trial " << trial;
    crossing += expected;
  }
  EXPECT_GT(crossing, 200);
  EXPECT_LT(crossing, 1800);
}

// A square cut along a random line: every point belongs to exactly one part.
TEST(Case_Polygon, SharesItsBorderWithNoOther) {
  std::mt19937_64 engine(71);
  const auto uniform = [&](double from, double to) { return test::uniform(engine, from, to); };
  for (int trial = 0; trial < 200; ++trial) {
    const double low = uniform(1, 9), high = uniform(1, 9);
    const Polygon left{{0, 0}, {low, 0}, {high, 10}, {0, 10}}, right{{high, 10}, {low, 0}, {10, 0}, {10, 10}};
    for (int point = 0; point < 200; ++point) {
      const double y = uniform(0, 10);
      const double x = point % 2 == 0 ? low + y / 10 * (high - low) : uniform(0, 10);
      ASSERT_NE(contains(left, {x, y}), contains(right, {x, y}));
    }
  }
}

TEST(Case_Zones, TheLastOverAPointCounts) {
  TerrainSection terrain;
  terrain.material = 7;
  terrain.zones = {makeZone(1, {{{103, -45}, {111, -45}, {111, -39}, {103, -39}}, {}}),
                   makeZone(2, {{{105, -45}, {125, -45}, {105, -25}}, {}})};
  for (double x = 100.5; x < 130; ++x)
    for (double y = -49.5; y < -20; ++y) {
      const bool inSecond = x >= 105 && y >= -45 && x + y < 80;
      const bool inFirst = x >= 103 && x < 111 && y >= -45 && y < -39;
      EXPECT_EQ(terrain.materialAt({x, y}), inSecond ? 2U : inFirst ? 1U : 7U) << x << " " << y;
    }
}

}  // namespace
}  // namespace cairn::rockfall::case_test
