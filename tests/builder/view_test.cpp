// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pages of `cairn view`: what stands in them, read by a reader of their own, and the command. tests/view opens them in
// a browser.
#include "cairn/builder/view.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "builder_meshes.h"
#include "built_trees.h"
#include "interrupted_program.h"
#include "run_program.h"

namespace cairn::builder::view_test {
namespace {

using Json = nlohmann::json;

constexpr const char* kNoViewer = "this build has no viewer (CAIRN_VIEWER): node and npm were missing";

Json sceneOf(const std::string& html) {
  const std::string begin = R"(<script type="application/json" id="scene">)";
  const std::size_t from = html.find(begin) + begin.size();
  return Json::parse(html.substr(from, html.find("</script>", from) - from));
}

std::string decoded(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

template <class Number>
std::vector<Number> numbers(const Json& base64) {
  const std::string bytes = decoded(base64.get<std::string>());
  std::vector<Number> list(bytes.size() / sizeof(Number));
  std::memcpy(list.data(), bytes.data(), bytes.size());
  return list;
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(ViewPage, HoldsEveryNodeOfATreeAndItsMesh) {
  if (!hasViewer()) GTEST_SKIP() << kNoViewer;
  const SphereTree tree = test::quickTree(test::torus(1, 0.3, 16, 8));
  const Result<ViewPage> page = viewPage({.title = "torus", .facts = {}, .links = {viewLink(tree)}, .joints = {}});
  ASSERT_TRUE(page.ok());
  const Json link = sceneOf(page.value().html).at("links").at(0);
  const auto centers = numbers<float>(link["spheres"]["centers"]), radii = numbers<float>(link["spheres"]["radii"]);
  const auto errors = numbers<float>(link["spheres"]["errors"]), inner = numbers<float>(link["spheres"]["inner_radii"]);
  const auto parents = numbers<std::uint32_t>(link["spheres"]["parents"]);
  ASSERT_EQ(radii.size(), tree.nodeCount());
  ASSERT_EQ(centers.size(), 3 * radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const NodeData& node = tree.data().nodes[i];
    EXPECT_EQ(Vec3(centers[3 * i], centers[3 * i + 1], centers[3 * i + 2]), node.center);
    EXPECT_EQ(std::tuple(radii[i], errors[i], inner[i], parents[i]),
              std::tuple(node.radius, node.error, node.innerRadius, node.parent));
  }
  EXPECT_EQ(numbers<float>(link["mesh"]["vertices"]).size(), 3 * tree.vertices().size());
  EXPECT_EQ(numbers<std::uint32_t>(link["mesh"]["triangles"]).size(), 3 * tree.triangles().size());
  EXPECT_EQ(numbers<std::uint32_t>(link["spheres"]["region_triangles"]), tree.data().regionTriangles);
}

TEST(ViewPage, TakesHostileNamesAsText) {
  if (!hasViewer()) GTEST_SKIP() << kNoViewer;
  const std::string name =
      "</title></script><img src=x onerror=alert(1)><!--<script>{{cairn-scene}}{{cairn-title}}&\"'\xFF";
  ViewLink link = viewLink(test::torus(1, 0.3, 16, 8));
  link.name = name;
  const Result<ViewPage> hostile = viewPage({.title = name, .facts = {{name, name}}, .links = {link}, .joints = {}});
  link.name = "plain";
  const Result<ViewPage> plain = viewPage({.title = "plain", .facts = {}, .links = {link}, .joints = {}});
  ASSERT_TRUE(hostile.ok() && plain.ok());
  for (const char* part : {"</script", "<script", "<img", "<!--", "</title"})
    EXPECT_EQ(countOf(hostile.value().html, part), countOf(plain.value().html, part)) << part;
  const std::string read = name.substr(0, name.size() - 1) + "\xEF\xBF\xBD";  // what is no UTF-8 is replaced
  const Json scene = sceneOf(hostile.value().html);
  EXPECT_EQ(scene.at("title"), read);
  EXPECT_EQ(scene.at("links").at(0).at("name"), read);
}

TEST(ViewPage, AsksNothingOfANetwork) {
  if (!hasViewer()) GTEST_SKIP() << kNoViewer;
  const auto page =
      viewPage({.title = "box", .facts = {}, .links = {viewLink(test::torus(1, 0.3, 16, 8))}, .joints = {}});
  ASSERT_TRUE(page.ok());
  EXPECT_NE(page.value().html.find("Content-Security-Policy\" content=\"default-src 'none'"), std::string::npos);
  EXPECT_EQ(countOf(page.value().html, " src=\"http"), 0U);
  EXPECT_NE(page.value().html.find("The MIT License"), std::string::npos);
  EXPECT_NE(page.value().html.find("three.js authors"), std::string::npos);
}

/// Two links on a joint that a third follows.
View jointedView() {
  View view{.title = "arm", .facts = {}, .links = {}, .joints = {}};
  for (const char* name : {"a", "b", "c"}) {
    view.links.push_back(viewLink(test::torus(1, 0.3, 16, 8)));
    view.links.back().name = name;
  }
  view.joints.push_back(
      {.name = "turn", .type = "revolute", .parent = 0, .child = 1, .rotation = {}, .translation = {}});
  view.joints.push_back(
      {.name = "slide", .type = "prismatic", .parent = 1, .child = 2, .rotation = {}, .translation = {}});
  view.joints[0].lower = -1;
  view.joints[0].upper = 2;
  view.joints[1].mimic = ViewMimic{0, 0.5, 0.25};
  view.ignoredPairs = {{0, 2}};
  return view;
}

TEST(ViewPage, HoldsJointsAndPairsToIgnore) {
  if (!hasViewer()) GTEST_SKIP() << kNoViewer;
  const Result<ViewPage> page = viewPage(jointedView());
  ASSERT_TRUE(page.ok()) << page.error().message;
  const Json scene = sceneOf(page.value().html);
  EXPECT_EQ(scene.at("ignored_pairs"), Json::parse("[[0, 2]]"));
  const Json turn = scene.at("joints").at(0), slide = scene.at("joints").at(1);
  EXPECT_EQ(std::tuple(turn.at("name"), turn.at("type"), turn.at("parent"), turn.at("child")),
            std::tuple("turn", "revolute", 0, 1));
  EXPECT_EQ(std::tuple(turn.at("lower"), turn.at("upper"), turn.contains("mimic")), std::tuple(-1, 2, false));
  EXPECT_EQ(slide.at("mimic"), Json::parse(R"({"joint": 0, "multiplier": 0.5, "offset": 0.25})"));
}

TEST(ViewPage, RefusesJointsThatHangNothingTogether) {
  if (!hasViewer()) GTEST_SKIP() << kNoViewer;
  using Change = void (*)(View&);
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<Change, const char*>> changes{
      {[](View& v) {
         v.links.clear();
         v.joints.clear();
         v.ignoredPairs.clear();
       },
       "needs a link"},
      {[](View& v) { v.joints[0].child = 3; }, "'turn' hangs on a link"},
      {[](View& v) { v.joints[1].parent = 7; }, "'slide' hangs on a link"},
      {[](View& v) { v.joints[0].lower = 3; }, "limit"},
      {[](View& v) { v.joints[0].upper = kNan; }, "finite"},
      {[](View& v) { v.joints[1].mimic->offset = kNan; }, "finite"},
      {[](View& v) { v.joints[1].mimic->joint = 2; }, "follows a joint that there is not"},
      {[](View& v) {
         v.joints[0].mimic = ViewMimic{1, 1, 0};
       },
       "follows another"},
      {[](View& v) {
         v.joints[1].child = 1;
         v.joints[1].parent = 0;
       },
       "another joint"},
      {[](View& v) { v.joints[0].parent = 2; }, "ring"},
      {[](View& v) { v.joints[0].parent = 1; }, "ring"},
      {[](View& v) {
         v.ignoredPairs = {{0, 3}};
       },
       "to ignore"}};
  for (const auto& [change, part] : changes) {
    View view = jointedView();
    change(view);
    const Result<ViewPage> page = viewPage(view);
    ASSERT_FALSE(page.ok()) << part;
    EXPECT_NE(page.error().message.find(part), std::string::npos) << page.error().message;
  }
}

class ViewTool : public testing::Test {
 protected:
  void SetUp() override {
    if (!hasViewer()) GTEST_SKIP() << kNoViewer;
    test::writeText(path("rock.obj"), test::objText(test::lumpyBall(2, 3)));
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string quoted(const std::string& name) const { return "'" + path(name) + "'"; }

  test::TemporaryFolder folder_;
};

TEST_F(ViewTool, TellsSizesThatAddUp) {
  const auto result =
      test::runProgram("cairn", "view " + quoted("rock.obj") + " --spheres 5 -o " + quoted("p.html") + " --json -");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const Json report = Json::parse(result.output);
  EXPECT_EQ(report.at("spheres"), 5);
  EXPECT_EQ(report.at("page_bytes"), std::filesystem::file_size(path("p.html")));
  const std::size_t parts = report.at("viewer_bytes").get<std::size_t>() + report.at("mesh_bytes").get<std::size_t>() +
                            report.at("sphere_bytes").get<std::size_t>();
  EXPECT_GE(report.at("page_bytes").get<std::size_t>() + 100, parts);
  EXPECT_LE(report.at("page_bytes").get<std::size_t>(), parts + 1000);
}

TEST_F(ViewTool, RefusesInOneSentence) {
  test::writeText(path("empty.obj"), "");
  test::writeText(path("cut.cairn"), "cairn, but cut");
  test::writeText(path("nan.obj"), "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string out = " -o " + quoted("p.html");
  for (const auto& [arguments, exitCode, part] :
       {std::tuple{"view " + quoted("rock.obj"), 2, "--output"}, std::tuple{"view" + out, 2, "INPUT"},
        std::tuple{"view " + quoted("none.obj") + out, 1, "none.obj"},
        std::tuple{"view " + quoted("empty.obj") + out, 1, "empty.obj"},
        std::tuple{"view " + quoted("cut.cairn") + out, 1, "cut.cairn"},
        std::tuple{"view " + quoted("cut.cairn") + " --spheres 3" + out, 1, "is a tree"},
        std::tuple{"view " + quoted("nan.obj") + out, 1, "nan.obj"},
        std::tuple{"view " + quoted("rock.obj") + " --spheres 0" + out, 2, "--spheres"},
        std::tuple{"view " + quoted("rock.obj") + " --repair --wrap" + out, 2, "--wrap"},
        std::tuple{"view " + quoted("rock.obj") + " -o " + quoted("no/p.html"), 1, "no/p.html"},
        std::tuple{"view " + quoted("rock.obj") + " -o " + quoted("rock.obj"), 1, "rock.obj"}}) {
    const auto result = test::runProgram("cairn", arguments);
    EXPECT_EQ(result.exitCode, exitCode) << arguments;
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(path("p.html"))) << arguments;
  }
}

TEST_F(ViewTool, EndsSoonAfterAnInterrupt) {
  const int code = test::exitCodeAfterSignal(std::filesystem::read_symlink("/proc/self/exe").parent_path() / "cairn",
                                             {"view", path("rock.obj"), "--spheres", "500", "-o", path("p.html")},
                                             SIGINT, std::chrono::milliseconds(700));
  EXPECT_EQ(code, 130);
  EXPECT_FALSE(std::filesystem::exists(path("p.html")));
}

}  // namespace
}  // namespace cairn::builder::view_test
