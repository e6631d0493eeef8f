// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bad robots: one sentence each, and nothing written.
#include <chrono>
#include <csignal>
#include <functional>

#include "interrupted_program.h"
#include "robot_run.h"

namespace cairn::builder::robot_refusal_test {
namespace {

using test::ProgramResult;

class BadRobot : public testing::Test {
 protected:
  void SetUp() override {
    test::writeText(path("box.obj"), test::objText(test::meshOf(test::cuboid({1, 1, 1}, 1))));
    test::writeText(path("empty.obj"), "");
    test::writeText(path("points.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    test::writeText(path("cut.stl"), std::string(90, '\1'));
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  ProgramResult run(const std::string& urdf, const std::string& options = "--spheres 2") {
    test::writeText(path("bad.urdf"), urdf);
    return test::runProgram("cairn", "robot '" + path("bad.urdf") + "' -o '" + path("out.urdf") +
                                         "' --check-poses 2 --primitives " + options);
  }
  void expectRefused(const std::string& urdf, const std::string& part, const std::string& options = "--spheres 2") {
    const ProgramResult result = run(urdf, options);
    EXPECT_EQ(result.exitCode, 1) << urdf << result.output;
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
    EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(path("out.urdf"))) << urdf;
  }

  test::TemporaryFolder folder_;
};

std::string robotOf(const std::string& inside) {
  return "<robot name=\"r\">" + inside + "</robot>";
}
std::string linkOf(const std::string& shape, const std::string& origin = "") {
  return robotOf("<link name=\"a\"><collision>" + origin + "<geometry>" + shape + "</geometry></collision></link>");
}
std::string meshLink(const std::string& file) {
  return linkOf("<mesh filename=\"" + file + "\"/>");
}

TEST_F(BadRobot, MeshesThatCannotBeUsed) {
  expectRefused(meshLink("no.obj"), "no.obj");
  expectRefused(meshLink("empty.obj"), "empty");
  expectRefused(meshLink("points.obj"), "points.obj");
  expectRefused(meshLink("cut.stl"), "cut.stl");
  expectRefused(meshLink("package://nobody/meshes/a.obj"), "--package-path nobody=FOLDER");
  expectRefused(meshLink("package://"), "package");
  expectRefused(meshLink("http://example.org/a.obj"), "scheme");
  expectRefused(meshLink("file:///no/such.obj"), "/no/such.obj");
  expectRefused(linkOf("<mesh filename=\"box.obj\" scale=\"1 0 1\"/>"), "scale");
  expectRefused(linkOf("<mesh filename=\"box.obj\" scale=\"1 1e300 1\"/>"), "scale");
  expectRefused(linkOf("<mesh filename=\"box.obj\" scale=\"1 1\"/>"), "scale");
  expectRefused(linkOf("<mesh/>"), "filename");
}

TEST_F(BadRobot, XmlThatIsNotRead) {
  expectRefused("", "XML");
  expectRefused("<robot name=\"r\"><link>", "XML");
  expectRefused("<mujoco/>", "no URDF");
  expectRefused("<robot name=\"r\"/><robot name=\"r\"/>", "outermost");
  std::string bomb = "<!DOCTYPE r [<!ENTITY a0 \"ha\">";
  for (int i = 1; i < 12; ++i)
    bomb += "<!ENTITY a" + std::to_string(i) + " \"&a" + std::to_string(i - 1) + ";&a" + std::to_string(i - 1) + ";\">";
  expectRefused(bomb + "]><robot name=\"&a11;\"/>", "DOCTYPE");
  expectRefused(robotOf("<xacro:arm/>"), "xacro");
  std::string deep;
  for (int i = 0; i < 300000; ++i) deep += "<a>";
  expectRefused(robotOf(deep), "XML");
}

TEST_F(BadRobot, NumbersThatAreNotFinite) {
  const std::string box = "<box size=\"1 1 1\"/>";
  expectRefused(linkOf(box, "<origin xyz=\"0 nan 0\"/>"), "xyz=\"0 nan 0\"");
  expectRefused(linkOf(box, "<origin rpy=\"0 0 1e999\"/>"), "rpy");
  expectRefused(linkOf(box, "<origin xyz=\"0 0\"/>"), "3 finite numbers");
  expectRefused(linkOf(box, "<origin xyz=\"0 0 0 0\"/>"), "3 finite numbers");
  expectRefused(linkOf("<box size=\"1 -1 1\"/>"), "size");
  expectRefused(linkOf("<cylinder radius=\"0\" length=\"1\"/>"), "radius");
  expectRefused(linkOf("<sphere radius=\"inf\"/>"), "radius");
  expectRefused(linkOf("<capsule radius=\"1\"/>"), "capsule");
  expectRefused(linkOf(""), "geometry");
}

TEST_F(BadRobot, LinksThatAreNoTree) {
  const auto link = [](const std::string& name) { return "<link name=\"" + name + "\"/>"; };
  const auto joint = [](const std::string& name, const std::string& a, const std::string& b) {
    return "<joint name=\"" + name + "\" type=\"fixed\"><parent link=\"" + a + "\"/><child link=\"" + b +
           "\"/></joint>";
  };
  expectRefused(robotOf(""), "no links");
  expectRefused(robotOf(link("a") + link("b")), "one root");
  expectRefused(robotOf(link("a") + link("b") + link("c") + joint("1", "b", "c") + joint("2", "c", "b")), "ring");
  expectRefused(robotOf(link("a") + link("b") + joint("1", "a", "b") + joint("2", "b", "a")), "ring");
  expectRefused(robotOf(link("a") + link("b") + link("c") + joint("1", "a", "c") + joint("2", "b", "c")), "child of");
  expectRefused(robotOf(link("a") + link("a")), "two links");
  expectRefused(robotOf(link("a") + link("b") + joint("1", "a", "x")), "'x'");
  expectRefused(robotOf(link("a") + link("b") +
                        "<joint name=\"j\" type=\"ball\"><parent link=\"a\"/><child link=\"b\"/></joint>"),
                "ball");
  const std::string open = "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/>";
  expectRefused(robotOf(link("a") + link("b") + open + "</joint>"), "<limit>");
  expectRefused(robotOf(link("a") + link("b") + open + "<limit lower=\"1\" upper=\"0\"/></joint>"), "limit");
  expectRefused(robotOf(link("a") + link("b") + open + "<axis xyz=\"0 0 0\"/><limit upper=\"1\"/></joint>"), "axis");
  expectRefused(robotOf(link("a") + link("b") + open + "<limit upper=\"1\"/><mimic joint=\"j\"/></joint>"), "follows");
}

TEST_F(BadRobot, BudgetsThatCannotBeKept) {
  const std::string two = robotOf(
      "<link name=\"a\"><collision><geometry><mesh filename=\"box.obj\"/></geometry></collision>"
      "<collision><geometry><box size=\"1 2 3\"/></geometry></collision></link>");
  expectRefused(two, "2 meshes for 1", "--spheres 1");
  expectRefused(two, "too few", "--total 1");
  expectRefused(two, "'b'", "--spheres 3 --link-spheres b=2");
  expectRefused(two, "'b'", "--spheres 3 --tool-frame b");
  for (const std::string& options :
       {std::string(""), std::string("--spheres 2 --total 4"), std::string("--spheres 2 --link-spheres a"),
        std::string("--spheres 2 --link-spheres a=x"), std::string("--spheres 2 --package-path =x"),
        std::string("--max-error nan"), std::string("--total 0"), std::string("--spheres 2 --objective best")}) {
    const ProgramResult result = run(two, options);
    EXPECT_EQ(result.exitCode, 2) << options << result.errors;
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
  }
}

TEST_F(BadRobot, WhatMujocoCannotHave) {
  const std::string joint = "<parent link=\"a\"/><child link=\"b\"/><limit upper=\"1\"/></joint>";
  expectRefused(robotOf("<link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"revolute\">" + joint),
                "neither mass", "--spheres 2 --mjcf '" + path("m.xml") + "'");
  expectRefused(robotOf("<link name=\"a\"/><link name=\"b\"><collision><geometry><sphere radius=\"1\"/></geometry>"
                        "</collision></link><joint name=\"j\" type=\"planar\">" +
                        joint),
                "planar", "--spheres 2 --mjcf '" + path("m.xml") + "'");
}

TEST_F(BadRobot, EndsSoonAfterAnInterrupt) {
  test::writeText(path("lump.obj"), test::objText(test::lumpyBall(6, 3)));
  test::writeText(path("bad.urdf"), meshLink("lump.obj"));
  const auto start = std::chrono::steady_clock::now();
  const int code = test::exitCodeAfterSignal(std::filesystem::read_symlink("/proc/self/exe").parent_path() / "cairn",
                                             {"robot", path("bad.urdf"), "--spheres", "4000", "-o", path("out.urdf")},
                                             SIGINT, std::chrono::milliseconds(3000));
  EXPECT_EQ(code, 130);
  EXPECT_FALSE(std::filesystem::exists(path("out.urdf")));
  // A second of work, with room for a machine that is busy.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(15));
}

}  // namespace
}  // namespace cairn::builder::robot_refusal_test
