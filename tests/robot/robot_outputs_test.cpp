// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `cairn robot` writes, read back by others: urdfdom, a strict parser in Python, and MuJoCo (mujoco_test.cpp).
#include <urdf_parser/urdf_parser.h>

#include <regex>
#include <set>

#include "robot_run.h"

namespace cairn::builder::robot_outputs_test {
namespace {

using test::LinkQuads;
using test::RobotRun;
using test::sharedRun;

/// All outputs hold the digits of a double.
constexpr double kSame = 0;

LinkQuads spheresByUrdfdom(const std::string& file) {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(file);
  LinkQuads spheres;
  if (!model) return spheres;
  for (const auto& [name, link] : model->links_)
    for (const auto& collision : link->collision_array) {
      const auto* const sphere = dynamic_cast<const urdf::Sphere*>(collision->geometry.get());
      const urdf::Pose& pose = collision->origin;
      if (sphere != nullptr)
        spheres[name].push_back({pose.position.x, pose.position.y, pose.position.z, sphere->radius});
    }
  return spheres;
}

nlohmann::json readStrictly(const std::string& format, const std::string& file) {
  test::TemporaryFolder folder;
  const auto output = folder.path() / "output";
  const std::string command = std::string("PYTHONDONTWRITEBYTECODE=1 python3 '") + CAIRN_ROBOT_TESTS +
                              "/read_robot_formats.py' " + format + " '" + file + "' > '" + output.string() + "'";
  if (std::system(command.c_str()) != 0) return {};
  return nlohmann::json::parse(test::contentOf(output));
}

void expectSame(const LinkQuads& expected, const nlohmann::json& actual, const std::string& format) {
  ASSERT_EQ(actual.size(), expected.size()) << format;
  for (const auto& [link, quads] : expected) {
    ASSERT_TRUE(actual.contains(link)) << format << ' ' << link;
    ASSERT_EQ(actual.at(link).size(), quads.size()) << format << ' ' << link;
    for (std::size_t i = 0; i < quads.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(actual.at(link)[i][k].get<double>(), quads[i][k], kSame) << format << ' ' << link << ' ' << i;
  }
}

TEST(RobotOutputs, UrdfHasAsManySpheresAsAsked) {
  ASSERT_EQ(sharedRun().result.exitCode, 0) << sharedRun().result.errors;
  const LinkQuads spheres = spheresByUrdfdom(sharedRun().out("out.urdf"));
  const std::map<std::string, std::size_t> expected{
      {"base", 5}, {"upper", 5},   {"slider", 6},  // one is the URDF's own
      {"left", 7}, {"bracket", 5}, {"right", 5}};
  ASSERT_EQ(spheres.size(), expected.size());
  for (const auto& [link, count] : expected) {
    EXPECT_EQ(spheres.at(link).size(), count) << link;
    EXPECT_EQ(sharedRun().link(link).at("spheres"), count) << link;
  }
}

TEST(RobotOutputs, EveryFormatHoldsTheSameSpheres) {
  ASSERT_EQ(sharedRun().result.exitCode, 0) << sharedRun().result.errors;
  const LinkQuads spheres = spheresByUrdfdom(sharedRun().out("out.urdf"));
  std::set<std::set<std::string>> ignored;
  for (const std::string format : {"srdf", "curobo", "xrdf", "mjcf"}) {
    if ((format == "curobo" || format == "xrdf") && std::system("python3 -c 'import yaml' 2> /dev/null") != 0) continue;
    const nlohmann::json read = readStrictly(format, sharedRun().out(format));
    ASSERT_FALSE(read.is_null()) << format;
    expectSame(spheres, read.at("spheres"), format);
    std::set<std::set<std::string>> pairs;
    for (const auto& pair : read.at("ignored")) pairs.insert({pair[0].get<std::string>(), pair[1].get<std::string>()});
    if (ignored.empty()) ignored = pairs;
    EXPECT_EQ(pairs, ignored) << format;
  }
  // Parent and child of all five joints, and whatever the report calls always.
  std::set<std::set<std::string>> expected{
      {"base", "upper"}, {"upper", "slider"}, {"slider", "bracket"}, {"bracket", "left"}, {"bracket", "right"}};
  for (const auto& pair : sharedRun().report.at("self_collision").at("always"))
    expected.insert({pair[0].get<std::string>(), pair[1].get<std::string>()});
  EXPECT_EQ(ignored, expected);
}

TEST(RobotOutputs, UrdfIsUnchangedButForItsCollisions) {
  const auto withoutCollisions = [](std::string text) {
    for (std::size_t begin = 0; (begin = text.find("<collision", begin)) != std::string::npos;) {
      const std::size_t end = text.find("</collision>", begin) + std::string("</collision>").size();
      text.erase(begin, end - begin);
    }
    // Lines of collisions are then empty; how many there are may differ.
    return std::regex_replace(text, std::regex("(\n *)+"), "\n");
  };
  const std::string before = test::generatedRobotUrdf(), after = test::contentOf(sharedRun().out("out.urdf"));
  EXPECT_EQ(withoutCollisions(after), withoutCollisions(before));
  EXPECT_EQ(after.substr(0, after.find("<collision")), before.substr(0, before.find("<collision")));
}

TEST(RobotOutputs, PrimitivesAreKeptUnlessAsked) {
  const RobotRun plain("--spheres 2 --check-poses 5");
  EXPECT_EQ(plain.result.exitCode, 1);  // the SRDF asked for too cannot hold a box
  EXPECT_NE(plain.result.errors.find("--primitives"), std::string::npos) << plain.result.errors;
  EXPECT_FALSE(std::filesystem::exists(plain.out("out.urdf")));
  const auto again = test::runProgram(
      "cairn", "robot '" + plain.urdf.string() + "' -o '" + plain.out("out.urdf") + "' --spheres 2 --check-poses 5");
  ASSERT_EQ(again.exitCode, 0) << again.errors;
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDFFile(plain.out("out.urdf"));
  ASSERT_TRUE(model);
  const auto& shapes = model->getLink("base")->collision_array;
  ASSERT_EQ(shapes.size(), 2U);
  const auto* const box = dynamic_cast<const urdf::Box*>(shapes[0]->geometry.get());
  ASSERT_NE(box, nullptr);
  EXPECT_EQ(box->dim.x, 0.3);
  EXPECT_NE(dynamic_cast<const urdf::Cylinder*>(shapes[1]->geometry.get()), nullptr);
}

TEST(RobotOutputs, AreTheSameForAnyNumberOfThreads) {
  const RobotRun one("--total 20 --primitives --check-poses 10 --threads 1"),
      three("--total 20 --primitives --check-poses 10 --threads 3");
  ASSERT_EQ(one.result.exitCode, 0) << one.result.errors;
  ASSERT_EQ(three.result.exitCode, 0) << three.result.errors;
  for (const char* file : {"out.urdf", "srdf", "mjcf", "xrdf"})
    EXPECT_EQ(test::contentOf(one.out(file)), test::contentOf(three.out(file))) << file;
  EXPECT_EQ(one.report.at("self_collision"), three.report.at("self_collision"));
  EXPECT_LE(one.report.at("spheres"), 21);  // 20, and the sphere of the URDF
  EXPECT_GE(one.report.at("spheres"), 20);  // fingers share a set: one may be over
}

}  // namespace
}  // namespace cairn::builder::robot_outputs_test
