// SPDX-License-Identifier: GPL-3.0-or-later
//
// `cairn certify` for robots: what it proves of spheres it did not place.
#include <fstream>
#include <regex>

#include "robot_run.h"

namespace cairn::builder::certify_robot_test {
namespace {

using nlohmann::json;
using test::sharedRun;
namespace fs = std::filesystem;

class CertifyRobot : public ::testing::Test {
 protected:
  test::ProgramResult certify(const fs::path& spheres, const std::string& rest = "") const {
    return test::runProgram("cairn", "certify '" + sharedRun().urdf.string() + "' '" + spheres.string() + "' --json '" +
                                         report().string() + "' " + rest);
  }
  fs::path report() const { return temporary_.path() / "proof.json"; }
  std::map<std::string, json> links() const {
    std::map<std::string, json> links;
    const json proof = json::parse(test::contentOf(report()));
    for (const json& link : proof.at("links")) links[link.at("link")] = link;
    return links;
  }
  /// The fitted URDF with each radius changed but that of the robot's own sphere.
  template <class Change>
  fs::path changed(const Change& change) const {
    const std::string text = test::contentOf(sharedRun().out("out.urdf"));
    static const std::regex kRadius("radius=\"([^\"]+)\"");
    std::string result;
    auto from = text.cbegin();
    for (std::sregex_iterator it(text.begin(), text.end(), kRadius), end; it != end; ++it) {
      result.append(from, text.cbegin() + it->position(1));
      const double radius = std::stod((*it)[1].str());
      result += std::to_string(radius == 0.03 ? radius : change(radius));
      from = text.cbegin() + it->position(1) + it->length(1);
    }
    result.append(from, text.cend());
    const fs::path file = temporary_.path() / "changed.urdf";
    std::ofstream(file) << result;
    return file;
  }

  test::TemporaryFolder temporary_;
};

TEST_F(CertifyRobot, ProvesAgainWhatTheFitProved) {
  const test::ProgramResult result = certify(sharedRun().out("out.urdf"));
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  const auto found = links();
  ASSERT_FALSE(found.empty());
  for (const auto& [name, link] : found) {
    const json fitted = sharedRun().link(name);
    EXPECT_TRUE(link.at("coverage_proven").get<bool>()) << name;
    EXPECT_EQ(link.at("certified_leaves_out_m"), 0) << name;
    std::size_t spheres = 0;
    for (const json& part : fitted.at("collisions"))
      if (part.at("solid") != "kept") spheres += part.at("spheres").get<std::size_t>();
    EXPECT_EQ(link.at("spheres"), spheres) << name;
    // Spheres of one mesh lie in another of the link too: it may prove less, by its own tolerance never more.
    EXPECT_LE(link.at("certified_sticks_out_m").get<double>(),
              1.003 * fitted.at("certified_sticks_out_m").get<double>() + 1e-5)
        << name;
    EXPECT_GT(link.at("certified_sticks_out_m").get<double>(), 0) << name;
    EXPECT_NE(result.output.find(name), std::string::npos);
  }
}

TEST_F(CertifyRobot, TellsWhatSmallerSpheresLeaveOut) {
  const test::ProgramResult result = certify(changed([](double radius) { return 0.9 * radius; }));
  EXPECT_EQ(result.exitCode, 1);
  EXPECT_NE(result.errors.find("leave out up to"), std::string::npos) << result.errors;
  for (const auto& [name, link] : links()) {
    EXPECT_FALSE(link.at("coverage_proven").get<bool>()) << name;
    EXPECT_GT(link.at("certified_leaves_out_m").get<double>(), 0) << name;
  }
}

TEST_F(CertifyRobot, TellsHowFarLargerSpheresStickOut) {
  ASSERT_EQ(certify(sharedRun().out("out.urdf")).exitCode, 0);
  const auto before = links();
  ASSERT_EQ(certify(changed([](double radius) { return radius + 0.01; })).exitCode, 0);
  for (const auto& [name, link] : links())
    EXPECT_NEAR(link.at("certified_sticks_out_m").get<double>(),
                before.at(name).at("certified_sticks_out_m").get<double>() + 0.01, 1e-3)
        << name;
}

TEST_F(CertifyRobot, RefusesWhatHoldsNoSpheres) {
  const test::ProgramResult itself = certify(sharedRun().urdf);
  EXPECT_EQ(itself.exitCode, 1);
  EXPECT_NE(itself.errors.find("of which nothing can be proved"), std::string::npos) << itself.errors;
  const fs::path other = temporary_.path() / "other.urdf";
  std::ofstream(other) << R"(<robot name="other"><link name="elsewhere"/></robot>)";
  const test::ProgramResult stranger = certify(other);
  EXPECT_EQ(stranger.exitCode, 1);
  EXPECT_NE(stranger.errors.find("there is no link 'base'; give spheres of the same robot"), std::string::npos)
      << stranger.errors;
  const test::ProgramResult package = certify(other, "--package-path nonsense");
  EXPECT_EQ(package.exitCode, 2) << package.errors;
  EXPECT_NE(package.errors.find("'nonsense' is not NAME=VALUE"), std::string::npos) << package.errors;
  EXPECT_FALSE(fs::exists(report()));
}

// Without --primitives boxes and cylinders stay: of a link that has nothing else nothing is proved.
TEST_F(CertifyRobot, LeavesOutLinksOfKeptShapes) {
  const fs::path output = temporary_.path() / "kept.urdf";
  ASSERT_EQ(test::runProgram("cairn", "robot '" + sharedRun().urdf.string() + "' -o '" + output.string() +
                                          "' --spheres 5 --check-poses 0")
                .exitCode,
            0);
  ASSERT_EQ(certify(output).exitCode, 0);
  EXPECT_FALSE(links().contains("base"));
  EXPECT_TRUE(links().contains("upper"));
}

}  // namespace
}  // namespace cairn::builder::certify_robot_test
