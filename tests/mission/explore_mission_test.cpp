// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include <vantage/io/ply.hpp>

#include "mission_program.hpp"

// The program examples/scene where it explores, as its users start it.
namespace {

using namespace vantage;

class ExploreMission : public MissionProgram {
 protected:
  ExploreMission() : MissionProgram("scene") {}
  [[nodiscard]] nlohmann::json mission(const std::string& name) const {
    return nlohmann::json::parse(text_of(folder.path / name / "mission.json"));
  }
};

const std::string room = "--room 1 --pixels 128 --fov 75 --clock modelled --voxel 0.05 --body 0.15";

TEST_F(ExploreMission, SeesTheRoomAndTouchesNothing) {
  const Ended e = run(room + " --method fbe --measurements 60" + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto a = folder.path / "a";
  EXPECT_EQ(e.out, (a / "report.html").string() + "\n");
  const auto json = mission("a");
  EXPECT_EQ(json["config"]["method"], "fbe");
  const auto& steps = json["steps"];
  ASSERT_GE(steps.size(), 3u);
  double coverage = 0;
  for (const auto& step : steps) {
    const auto& m = step["metrics"];
    EXPECT_GE(m["coverage"].get<double>(), coverage);
    coverage = m["coverage"];
    EXPECT_EQ(m["collisions"], 0);
    if (step["planned"].get<bool>()) { EXPECT_GT(m["clearance_m"].get<double>(), 0); }
  }
  EXPECT_GE(coverage, 0.9);
  for (const char* picture : {"map.png", "growth.png", "coverage.png", "view_1.png", "mesh_1.png"})
    EXPECT_EQ(text_of(a / picture).substr(1, 3), "PNG") << picture;
  EXPECT_GT(read_ply_mesh(a / "mesh.ply").triangles.size(), 500u);
  EXPECT_EQ(text_of(a / "map.bt").substr(0, 9), "# Octomap");
  EXPECT_EQ(text_of(a / "path.csv").substr(0, 4), "leg,");
  EXPECT_NE(text_of(a / "report.html").find("</html>"), std::string::npos);
}

TEST_F(ExploreMission, TakesNoMoreMeasurementsThanItIsTold) {
  ASSERT_EQ(run(room + " --method fbe --measurements 2" + out("a")).code, 0);
  EXPECT_EQ(mission("a")["steps"].back()["step"], 2);
}

TEST_F(ExploreMission, EndsWhenNothingIsLeftToSee) {
  ASSERT_EQ(
      run("--room 1 --method fbe --pixels 96 --fov 100 --clock modelled --voxel 0.05 --body 0.15 --map-voxel 0.15" +
          out("a"))
          .code,
      0);
  const auto last = mission("a")["steps"].back();
  EXPECT_LT(last["elapsed_s"].get<double>(), 900);
  EXPECT_GE(last["metrics"]["coverage"].get<double>(), 0.94);
}

TEST_F(ExploreMission, EveryMethodExploresAndRepeatsWithAnyThreads) {
  for (const std::string method : {"fbe", "nbvp", "information_gain", "random"}) {
    const std::string arguments = room + " --measurements 24 --method " + method;
    ASSERT_EQ(run(arguments + " --threads 1" + out("a")).code, 0) << method;
    ASSERT_EQ(run(arguments + " --threads 2" + out("b")).code, 0) << method;
    for (const char* name : {"mission.json", "mesh.ply", "map.bt", "path.csv"})
      EXPECT_EQ(text_of(folder.path / "a" / name), text_of(folder.path / "b" / name)) << method << ' ' << name;
    const auto steps = mission("a")["steps"];
    EXPECT_GT(steps.back()["metrics"]["coverage"].get<double>(), steps.front()["metrics"]["coverage"].get<double>())
        << method;
    EXPECT_EQ(steps.back()["metrics"]["collisions"], 0) << method;
  }
}

TEST_F(ExploreMission, KilledAndResumed) {
  for (const std::string method : {"fbe", "nbvp", "information_gain", "random"})
    expect_to_survive(room + " --measurements 24 --method " + method, 2,
                      {"mission.json", "map.bt", "mesh.ply", "path.csv", "growth.png", "views/poses.txt"});
}

TEST_F(ExploreMission, ResumingAnotherMissionIsRefused) {
  const std::string few = room + " --method fbe --measurements 24";
  ASSERT_EQ(run(few + out("a")).code, 0);
  const std::string before = text_of(folder.path / "a" / "mission.json");
  const Ended e = run(few + " --speed 2 --resume" + out("a"));
  EXPECT_EQ(e.code, 2);
  EXPECT_NE(e.err.find("speed_m_s: 1.0 there, 2.0 here"), e.err.npos) << e.err;
  EXPECT_EQ(text_of(folder.path / "a" / "mission.json"), before);
}

TEST_F(ExploreMission, BadInputIsOneLineAndCodeTwo) {
  const auto refused = [&](const std::string& arguments, const std::string& says) {
    const Ended e = run(arguments + out("x"));
    EXPECT_EQ(e.code, 2) << arguments;
    EXPECT_NE(e.err.find(says), e.err.npos) << e.err;
    EXPECT_EQ(std::count(e.err.begin(), e.err.end(), '\n'), 1) << e.err;
  };
  refused("--room 1 --start 0 0 -5", "outside of the scene; expected --start X Y Z between");
  refused("--room 1 --method fbe --body 9", "within 9 m of a surface");
  refused("--room 1 --method fbe --refine 5", "--refine");
  refused("--room 1 --method nbvp --test-views 5", "--test-views");
  refused("--scene '' --method fbe", "--scene");
  refused("--room 1 --map-voxel 0", "--map-voxel");
  refused("--object a.obj --method fbe", "--scene or --room");
}

}  // namespace
