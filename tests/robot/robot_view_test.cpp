// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a page of `cairn view` gets of a robot, judged by urdfdom, the meshes' makers and brute force.
#include "cairn/builder/robot_view.h"

#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cairn/builder/robot.h"
#include "distance_oracle.h"
#include "robot_run.h"

namespace cairn::builder::robot_view_test {
namespace {

/// The generated robot and a page of it.
struct RobotViewRun {
  test::TemporaryFolder folder;
  std::filesystem::path urdf = test::writeGeneratedRobot(folder.path());
  RobotModel model = readUrdf(urdf).value();

  Result<View> view(std::optional<std::uint32_t> spheres, std::uint32_t poses = 10) const {
    RobotViewOptions options;
    options.spheres = spheres;
    options.poses = poses;
    return robotView(model, urdf, options);
  }
};

const RobotViewRun& sharedRobot() {
  static const RobotViewRun run;
  return run;
}

/// Fitted once.
const View& coveredView() {
  static const View view = sharedRobot().view(5, 60).value();
  return view;
}

const ViewLink& linkOf(const View& view, const std::string& name) {
  return *std::ranges::find(view.links, name, &ViewLink::name);
}

Vec3d vertexOf(const ViewLink& link, std::size_t i) {
  return link.origin + Vec3d(link.vertices[i]);
}

Vec3d placed(const urdf::Pose& pose, const Vec3d& p) {
  const urdf::Vector3 turned = pose.rotation * urdf::Vector3(p.x, p.y, p.z);
  return {turned.x + pose.position.x, turned.y + pose.position.y, turned.z + pose.position.z};
}

/// Every point has a vertex of the link from `first` on, in the order of the file.
void expectVertices(const ViewLink& link, const std::vector<Vec3d>& points, std::size_t first = 0) {
  ASSERT_GE(link.vertices.size(), first + points.size()) << link.name;
  // Coordinates of a link below a metre: float's rounding, and that of a text of six digits.
  constexpr double kRounding = 2e-6;
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT(distance(vertexOf(link, first + i), points[i]), kRounding) << link.name << ' ' << i;
}

TEST(RobotView, HoldsTheJointsOfTheModel) {
  const View view = sharedRobot().view({}).value();
  const RobotModel& model = sharedRobot().model;
  const urdf::ModelInterfaceSharedPtr judge = urdf::parseURDFFile(sharedRobot().urdf.string());
  ASSERT_TRUE(judge);
  EXPECT_EQ(view.title, "six");
  EXPECT_TRUE(view.isMetric && view.isZUp);
  ASSERT_EQ(view.links.size(), judge->links_.size());
  ASSERT_EQ(view.joints.size(), judge->joints_.size());
  for (const ViewJoint& joint : view.joints) {
    const urdf::Joint& other = *judge->joints_.at(joint.name);
    EXPECT_EQ(view.links[joint.parent].name, other.parent_link_name);
    EXPECT_EQ(view.links[joint.child].name, other.child_link_name);
    const Vec3d p{0.3, -0.2, 0.7};
    EXPECT_LT(distance(joint.rotation * p + joint.translation, placed(other.parent_to_joint_origin_transform, p)),
              1e-14);
    if (other.limits)
      EXPECT_EQ(std::pair(joint.lower, joint.upper), std::pair(other.limits->lower, other.limits->upper));
    EXPECT_EQ(joint.mimic.has_value(), other.mimic != nullptr);
    if (joint.mimic) {
      EXPECT_EQ(view.joints[joint.mimic->joint].name, other.mimic->joint_name);
      EXPECT_EQ(std::pair(joint.mimic->multiplier, joint.mimic->offset),
                std::pair(other.mimic->multiplier, other.mimic->offset));
    }
  }
  const std::vector<std::string> types{"revolute", "prismatic", "fixed", "continuous", "revolute"};
  for (std::size_t j = 0; j < types.size(); ++j) EXPECT_EQ(view.joints[j].type, types[j]) << model.joints[j].name;
}

TEST(RobotView, HoldsMeshesInTheFrameOfTheirLink) {
  const View view = sharedRobot().view({}).value();
  const urdf::ModelInterfaceSharedPtr judge = urdf::parseURDFFile(sharedRobot().urdf.string());
  std::vector<Vec3d> left, right, lump;
  for (const Vec3d& v : test::finger().vertices) {
    left.push_back(v * 0.001);
    right.push_back({0.001 * v.x, -0.001 * v.y, 0.001 * v.z + 0.01});
  }
  expectVertices(linkOf(view, "left"), left);
  expectVertices(linkOf(view, "right"), right);
  const auto& origin = judge->getLink("slider")->collision_array[0]->origin;
  for (const Vec3d& v : test::lumpyBall(2, 7).vertices)
    lump.push_back(placed(origin, {0.05 * v.x, 0.08 * v.y, 0.04 * v.z}));
  expectVertices(linkOf(view, "slider"), lump);
  const ViewLink& base = linkOf(view, "base");
  expectVertices(base, {{-0.15, -0.1, 0}, {0.15, -0.1, 0}, {-0.15, 0.1, 0}});
  for (std::size_t i = 8; i < base.vertices.size(); ++i) {
    const Vec3d v = vertexOf(base, i);
    EXPECT_LE(std::hypot(v.x, v.y), 0.04 + 1e-6) << "of the cylinder";
    EXPECT_NEAR(std::abs(v.z - 0.15), 0.05, 1e-6);
  }
}

TEST(RobotView, ShowsSpheresOfTheFileWithoutAnError) {
  const View view = sharedRobot().view({}).value();
  for (const ViewLink& link : view.links) {
    ASSERT_EQ(link.spheres.size(), link.name == "slider" ? 1U : 0U) << link.name;
    if (link.spheres.empty()) continue;
    EXPECT_LT(distance(link.origin + Vec3d(link.spheres[0].center), {0.1, 0, 0}), 1e-7);
    EXPECT_EQ(link.spheres[0].radius, 0.03F);
    EXPECT_TRUE(std::isnan(link.spheres[0].error));
  }
  const ViewLink& covered = linkOf(coveredView(), "slider");
  EXPECT_EQ(std::ranges::count_if(covered.spheres, [](const ViewSphere& s) { return std::isnan(s.error); }), 1);
}

/// Whatever is found on a ball's surface lies no farther from the mesh than the ball's error.
TEST(RobotView, ErrorsOfSpheresHoldForEachOfThem) {
  TriangleMesh mesh = test::finger();
  for (Vec3d& v : mesh.vertices) v *= 0.001;
  const test::DistanceOracle oracle{mesh};
  const ViewLink& link = linkOf(coveredView(), "left");
  ASSERT_EQ(link.spheres.size(), 5U);
  const TriangleMesh directions = test::meshOf(test::ball(1, 3));
  double least = 1, most = 0;
  for (const ViewSphere& sphere : link.spheres) {
    double farthest = 0;
    for (const Vec3d& direction : directions.vertices)
      farthest =
          std::max(farthest, -oracle.depth(link.origin + Vec3d(sphere.center) + direction * double(sphere.radius)));
    EXPECT_LE(farthest, sphere.error + 1e-7);
    EXPECT_GT(farthest, 0.5 * sphere.error - 1e-4) << "an error that says something";
    least = std::min<double>(least, sphere.error);
    most = std::max<double>(most, sphere.error);
  }
  EXPECT_LT(least, most) << "each sphere has its own";
}

TEST(RobotView, ErrorsOfAPartReachWhatItsReportSays) {
  RobotOptions options;
  options.budget.perLink = 5;
  options.primitives = true;
  const FittedRobot fitted = fitRobot(sharedRobot().model, sharedRobot().urdf, options).value();
  for (const auto& parts : fitted.links)
    for (const RobotPart& part : parts) {
      ASSERT_EQ(part.errors.size(), part.solid ? part.balls.size() : 0U);
      if (part.solid) EXPECT_DOUBLE_EQ(*std::ranges::max_element(part.errors), part.sticksOut);
    }
}

TEST(RobotView, IgnoresThePairsThatTheReportDoes) {
  const View& view = coveredView();
  std::set<std::pair<std::string, std::string>> pairs, reported;
  for (const auto& [a, b] : view.ignoredPairs) pairs.insert(std::minmax(view.links[a].name, view.links[b].name));
  const auto& report = test::sharedRun().report.at("self_collision");  // 60 poses too
  for (const char* kind : {"adjacent", "always"})
    for (const auto& pair : report.at(kind))
      reported.insert(std::minmax(pair[0].get<std::string>(), pair[1].get<std::string>()));
  EXPECT_EQ(pairs, reported);
  EXPECT_TRUE(pairs.contains({"base", "upper"}));
}

TEST(RobotView, OfSpheresAloneHasTheSpheresOfTheText) {
  const std::filesystem::path urdf = test::sharedRun().out("out.urdf");
  const View view = robotView(readUrdf(urdf).value(), urdf, {}).value();
  const urdf::ModelInterfaceSharedPtr judge = urdf::parseURDFFile(urdf.string());
  for (const ViewLink& link : view.links) {
    const auto& collisions = judge->getLink(link.name)->collision_array;
    ASSERT_EQ(link.spheres.size(), collisions.size()) << link.name;
    EXPECT_TRUE(link.triangles.empty());
    for (std::size_t i = 0; i < collisions.size(); ++i) {
      const auto& p = collisions[i]->origin.position;
      EXPECT_LT(distance(link.origin + Vec3d(link.spheres[i].center), {p.x, p.y, p.z}), 1e-7);
      EXPECT_TRUE(std::isnan(link.spheres[i].error));
    }
  }
}

class RobotViewTool : public testing::Test {
 protected:
  void SetUp() override {
    if (!hasViewer()) GTEST_SKIP() << "this build has no viewer (CAIRN_VIEWER): node and npm were missing";
    test::writeText(path("box.obj"), test::objText(test::meshOf(test::cuboid({1, 1, 1}, 1))));
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  test::ProgramResult view(const std::string& urdf, const std::string& options) const {
    test::writeText(path("a.urdf"), urdf);
    return test::runProgram("cairn", "view '" + path("a.urdf") + "' -o '" + path("p.html") + "' " + options);
  }

  test::TemporaryFolder folder_;
};

std::string robotWith(const std::string& geometry, const std::string& joint) {
  return "<robot name=\"r\"><link name=\"a\"><collision><geometry>" + geometry +
         "</geometry></collision></link><link name=\"b\"/>"
         "<joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/>" +
         joint + "</joint></robot>";
}

TEST_F(RobotViewTool, RefusesInOneSentence) {
  const std::string box = "<box size=\"1 1 1\"/>", limit = "<limit lower=\"-1\" upper=\"1\"/>";
  const std::string good = robotWith("<mesh filename=\"box.obj\"/>", limit);
  for (const auto& [urdf, options, part] : std::vector<std::array<std::string, 3>>{
           {"<html/>", "", "no URDF"},
           {"no XML", "", "XML"},
           {robotWith(box, ""), "", "<limit>"},
           {robotWith(box, "<limit lower=\"1\" upper=\"0\"/>"), "", "limit"},
           {robotWith(box, "<limit lower=\"nan\" upper=\"0\"/>"), "", "nan"},
           {robotWith(box, limit + "<mimic joint=\"x\"/>"), "", "'x'"},
           {robotWith("<mesh filename=\"none.obj\"/>", limit), "", "none.obj"},
           {robotWith("<mesh filename=\"none.obj\"/>", limit), "--spheres 3", "none.obj"},
           {robotWith("<mesh filename=\"package://p/a.obj\"/>", limit), "", "--package-path p=FOLDER"},
           {"<robot name=\"r\"><link name=\"a\"/></robot>", "", "nothing to show"},
           {good, "--repair", "leave out"},
           {good, "--wrap --spheres 3", "leave out"}}) {
    const test::ProgramResult result = view(urdf, options);
    EXPECT_EQ(result.exitCode, 1) << urdf << result.output;
    EXPECT_EQ(result.errors.rfind("cairn: ", 0), 0U) << result.errors;
    EXPECT_EQ(result.errors.find('\n'), result.errors.size() - 1) << result.errors;
    EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(path("p.html"))) << urdf;
  }
  EXPECT_EQ(view(good, "--package-path =x").exitCode, 2);
  EXPECT_EQ(view(good, "").exitCode, 0);
}

TEST_F(RobotViewTool, WritesTheSameBytesForAnyNumberOfThreads) {
  const std::string urdf = robotWith("<mesh filename=\"box.obj\"/>", "<limit lower=\"-1\" upper=\"1\"/>");
  ASSERT_EQ(view(urdf, "--spheres 4 --threads 1").exitCode, 0);
  const std::string first = test::contentOf(path("p.html"));
  ASSERT_EQ(view(urdf, "--spheres 4 --threads 3").exitCode, 0);
  EXPECT_EQ(test::contentOf(path("p.html")), first);
}

}  // namespace
}  // namespace cairn::builder::robot_view_test
