// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <vantage/io/ply.hpp>
#include <vantage/io/splat_ply.hpp>

#include "mission_program.hpp"

// The program examples/scene where it reconstructs with surfels, as its users start it.
namespace {

using namespace vantage;

class ReconstructMission : public MissionProgram {
 protected:
  ReconstructMission() : MissionProgram("scene") {}
  [[nodiscard]] nlohmann::json mission(const std::string& name) const {
    return nlohmann::json::parse(text_of(folder.path / name / "mission.json"));
  }
};

const std::string room =
    "--room 1 --pixels 96 --fov 75 --clock modelled --voxel 0.05 --body 0.15 --map-voxel 0.1 --test-views 8 "
    "--judge-every 10";

TEST_F(ReconstructMission, OursLearnsToRenderTheRoomAndTouchesNothing) {
  const Ended e = run(room + " --measurements 16" + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto a = folder.path / "a";
  const auto json = mission("a");
  EXPECT_EQ(json["config"]["method"], "ours");
  EXPECT_EQ(json["config"]["map"], "surfels");
  double first_db = 0, last_db = 0;
  for (const auto& step : json["steps"]) {
    EXPECT_EQ(step["metrics"]["collisions"], 0);
    if (step["metrics"]["psnr"].is_null()) continue;  // not judged after every step
    if (first_db == 0) first_db = step["metrics"]["psnr"];
    last_db = step["metrics"]["psnr"];
  }
  EXPECT_GT(first_db, 0);
  EXPECT_GT(last_db, first_db + 1);
  for (const char* picture : {"rendering_1.png", "map.png", "growth.png", "coverage.png", "view_1.png", "mesh_1.png"})
    EXPECT_EQ(text_of(a / picture).substr(1, 3), "PNG") << picture;
  EXPECT_GT(read_ply_mesh(a / "mesh.ply").triangles.size(), 500u);
  const std::size_t surfels = json["steps"].back()["metrics"]["surfels"];
  EXPECT_GT(surfels, 1000u);
  EXPECT_EQ(read_surfel_ply(a / "surfels.ply").size(), surfels);
  EXPECT_EQ(read_splat_ply(a / "splats.ply").size(), surfels);
  EXPECT_NE(text_of(a / "report.html").find("</html>"), std::string::npos);
}

TEST_F(ReconstructMission, EveryMethodReconstructsAndRepeatsWithAnyThreads) {
  for (const std::string method : {"ours", "ours --preset thesis", "without_roi", "view_count", "fisher",
                                   "fbe --map surfels", "random --map surfels"}) {
    const std::string arguments = room + " --measurements 4 --method " + method;
    const Ended e = run(arguments + " --threads 1" + out("a"));
    ASSERT_EQ(e.code, 0) << method << e.err;
    ASSERT_EQ(run(arguments + " --threads 2" + out("b")).code, 0) << method;
    for (const char* name : {"mission.json", "surfels.ply", "path.csv"})
      EXPECT_EQ(text_of(folder.path / "a" / name), text_of(folder.path / "b" / name)) << method << ' ' << name;
  }
}

TEST_F(ReconstructMission, KilledAndResumed) {
  expect_to_survive(room + " --measurements 14", 3,
                    {"mission.json", "surfels.ply", "splats.ply", "mesh.ply", "path.csv", "growth.png",
                     "views/poses.txt", "rendering_1.png"});
}

TEST_F(ReconstructMission, BadInputIsOneLineAndCodeTwo) {
  const auto refused = [&](const std::string& arguments, const std::string& says) {
    const Ended e = run(arguments + out("x"));
    EXPECT_EQ(e.code, 2) << arguments;
    EXPECT_NE(e.err.find(says), e.err.npos) << e.err;
    EXPECT_EQ(std::count(e.err.begin(), e.err.end(), '\n'), 1) << e.err;
  };
  refused("--room 1 --method ours --map voxels", "--map");
  refused("--room 1 --method nbvp --map surfels", "--map");
  refused("--object a.obj --method ours", "--scene or --room");
}

}  // namespace
