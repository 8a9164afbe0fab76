// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

#include <vantage/io/ply.hpp>
#include <vantage/io/recording_any.hpp>

#include "mission_program.hpp"

// The program examples/scene, as its users start it.
namespace {

using namespace vantage;

class SceneMission : public MissionProgram {
 protected:
  SceneMission() : MissionProgram("scene") {}
  [[nodiscard]] nlohmann::json mission(const std::string& name) const {
    return nlohmann::json::parse(text_of(folder.path / name / "mission.json"));
  }
};

std::string stopping_after(int times) {
  return " --clock modelled --threshold 0.05 --measurements " + std::to_string(times);
}
std::string measuring(int times) { return " --pixels 96 --fov 90" + stopping_after(times); }
const std::string quick = measuring(5) + " --voxel 0.05 --method max_view_distance";

TEST_F(SceneMission, LeavesWhatItPromises) {
  const Ended e = run("--room 1" + quick + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto a = folder.path / "a";
  EXPECT_EQ(e.out, (a / "report.html").string() + "\n");

  const auto json = mission("a");
  EXPECT_EQ(json["stop_reason"], "stop_rule");
  ASSERT_EQ(json["steps"].size(), 5u);
  EXPECT_GT(json["steps"][1]["candidates"].get<int>(), 50);
  const auto metric = [&](std::size_t step, const char* name) {
    return json["steps"][step]["metrics"][name].get<double>();
  };
  for (std::size_t k = 1; k < 5; ++k) EXPECT_GE(metric(k, "coverage"), metric(k - 1, "coverage"));
  EXPECT_GT(metric(4, "coverage"), metric(0, "coverage"));
  EXPECT_GT(metric(4, "completeness"), 0.7 * metric(4, "coverage"));
  EXPECT_LE(metric(4, "coverage"), 1);
  EXPECT_GT(metric(4, "precision"), 0.5);
  EXPECT_LT(metric(4, "accuracy_m"), 0.1);

  const TriangleMesh mesh = read_ply_mesh(a / "mesh.ply");
  EXPECT_GT(mesh.triangles.size(), 500u);
  EXPECT_EQ(mesh.colours.size(), mesh.vertices.size());
  EXPECT_EQ(text_of(a / "mesh.glb").substr(0, 4), "glTF");
  for (const char* picture : {"plan.png", "view_1.png", "mesh_1.png"})
    EXPECT_EQ(text_of(a / picture).substr(1, 3), "PNG") << picture;
  EXPECT_NE(text_of(a / "report.html").find("</html>"), std::string::npos);
}

TEST_F(SceneMission, TheSameSeedGivesTheSameBytesWithAnyThreads) {
  ASSERT_EQ(run("--room 1 --threads 1" + quick + out("a")).code, 0);
  ASSERT_EQ(run("--room 1 --threads 2" + quick + out("b")).code, 0);
  ASSERT_EQ(run("--room 1 --seed 8" + quick + out("c")).code, 0);
  for (const char* name : {"mission.json", "mesh.ply", "views/depth/0005.png", "views/colour/0005.png", "plan.png"})
    EXPECT_EQ(text_of(folder.path / "a" / name), text_of(folder.path / "b" / name)) << name;
  EXPECT_NE(text_of(folder.path / "a" / "mesh.ply"), text_of(folder.path / "c" / "mesh.ply"));
}

TEST_F(SceneMission, ItsViewsAreARecordingThatReplays) {
  ASSERT_EQ(run("--room 1" + quick + out("a")).code, 0);
  const auto views = folder.path / "a" / "views";
  const Recording recording = read_recording(views);
  ASSERT_EQ(recording.size(), 5u);
  const Frame frame = recording.frame(0);
  EXPECT_EQ(frame.camera.width, 96);
  EXPECT_FALSE(frame.colour.empty());
  EXPECT_GT(frame.labels.maxCoeff(), 0);
  EXPECT_NE(text_of(views / "classes.txt").find(" wall\n"), std::string::npos);

  const Ended e =
      run("--recording '" + views.string() + "' --method in_order --voxel 0.05" + stopping_after(5) + out("b"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto before = mission("a")["steps"], after = mission("b")["steps"];
  ASSERT_EQ(after.size(), 5u);
  EXPECT_EQ(after[4]["view"]["position"], before[4]["view"]["position"]);  // rotations are made rigid again
  const auto triangles = [&](const char* name) {
    return static_cast<double>(read_ply_mesh(folder.path / name / "mesh.ply").triangles.size());
  };
  EXPECT_NEAR(triangles("b") / triangles("a"), 1, 0.1);  // depth was rounded

  // Into the folder that it lies in.
  ASSERT_EQ(run("--recording '" + views.string() + "' --voxel 0.05" + stopping_after(2) + out("a")).code, 0);
  EXPECT_EQ(read_recording(views).size(), 5u);
  EXPECT_EQ(mission("a")["steps"].size(), 2u);
}

TEST_F(SceneMission, LooksAtObjectsFromAround) {
  std::ofstream(folder.path / "brick.obj")
      << "v 0 0 0\nv .5 0 0\nv .5 .3 0\nv 0 .3 0\nv 0 0 .2\nv .5 0 .2\nv .5 .3 .2\nv 0 .3 .2\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const std::string brick = " '" + (folder.path / "brick.obj").string() + "'";
  const Ended e = run("--object" + brick + brick + measuring(14) + " --voxel 0.02" + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  EXPECT_GT(mission("a")["steps"][13]["metrics"]["coverage"].get<double>(), 0.8);
  for (const char* picture : {"view_1.png", "view_3.png", "view_13.png", "mesh_1.png"})  // every other of 14
    EXPECT_EQ(text_of(folder.path / "a" / picture).substr(1, 3), "PNG") << picture;
}

// Floor and walls lie on the bounds of the scene: the volume in which they are fused must go on behind them. Three
// views, then two, of a folder named with a slash at its end.
TEST_F(SceneMission, FusesTheWallsOfARoom) {
  std::filesystem::create_directory(folder.path / "hall");
  std::ofstream(folder.path / "hall" / "scene.json")
      << R"({"room": {"min": [-2, -2, 0], "max": [2, 2, 3], "colour": [0.9, 0.9, 0.8]}, "boxes": []})";
  for (const std::string voxel : {"0.02", "0.05"}) {
    const std::string common = "--scene '" + (folder.path / "hall/").string() +
                               "' --depth-noise 0 --method max_view_distance --voxel " + voxel + out("a");
    ASSERT_EQ(run(common + measuring(12)).code, 0);
    const auto json = mission("a");
    EXPECT_EQ(json["config"]["input"], "hall");
    const auto last = json["steps"].back()["metrics"];
    EXPECT_GT(last["coverage"].get<double>(), 0.5) << voxel;
    EXPECT_GT(last["completeness"].get<double>(), 0.85 * last["coverage"].get<double>()) << voxel;
    EXPECT_TRUE(std::filesystem::exists(folder.path / "a" / "view_12.png"));
    ASSERT_EQ(run(common + measuring(2)).code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder.path / "a" / "view_12.png")) << "of the mission before";
  }
}

TEST_F(SceneMission, LooksLevelFromWhereItIsTold) {
  std::ofstream(folder.path / "block.obj")  // without a start of its own; seen from inside
      << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const Ended e = run("--scene '" + (folder.path / "block.obj").string() +
                      "' --start 0.5 0.5 0.5 --method max_view_distance --body 0.1" + measuring(1) + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  EXPECT_NEAR(mission("a")["steps"][0]["view"]["forward"][0].get<double>(), 1, 1e-12);
}

TEST_F(SceneMission, NamesWhatAnObjectLacks) {
  std::ofstream(folder.path / "bare.obj") << "mtllib lost.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                             "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const Ended e = run("--no-views --object '" + (folder.path / "bare.obj").string() + "'" + measuring(1) + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  EXPECT_NE(e.err.find("lost.mtl"), e.err.npos) << e.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path / "a" / "views"));
}

TEST_F(SceneMission, BadInputIsOneLineAndCodeTwo) {
  const auto refused = [&](const std::string& arguments, const std::string& says) {
    const Ended e = run(arguments + out("x"));
    EXPECT_EQ(e.code, 2) << arguments;
    EXPECT_NE(e.err.find(says), e.err.npos) << e.err;
    EXPECT_EQ(std::count(e.err.begin(), e.err.end(), '\n'), 1) << e.err;
  };
  refused("--scene /no/such/scene", "/no/such/scene");
  refused("--recording /no/such/recording", "/no/such/recording");
  refused("--scene a --room 1", "one at most");
  refused("--room 1 --start 0 0 -5", "start");
  refused("--room 1 --method max_view_distance --resume", "--resume");
  refused("--room 1 --method magic", "--method");
  refused("--room 1 --threshold nan", "--threshold");
  refused("--room 1 --start nan 0 1", "--start");
  EXPECT_FALSE(std::filesystem::exists(folder.path / "x")) << "nothing was made of bad input";
  std::ofstream(folder.path / "empty.obj") << "v 0 0 0\n";
  refused("--scene '" + (folder.path / "empty.obj").string() + "'", "empty.obj");
  std::ofstream(folder.path / "nan.obj") << "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n";
  refused("--scene '" + (folder.path / "nan.obj").string() + "'", "nan.obj");
  std::ofstream(folder.path / "picture.obj") << "\x89PNG\r\n\x1a\n";
  refused("--object '" + (folder.path / "picture.obj").string() + "'", "picture.obj");
  std::filesystem::create_directory(folder.path / "odd");
  std::ofstream(folder.path / "odd" / "scene.json")
      << R"({"classes": ["table"], "boxes": [{"min": [0, 0, 0], "max": [1, 1, 1], "class": "chair"}]})";
  refused("--scene '" + (folder.path / "odd").string() + "'", "unknown class 'chair'");
  refused("--recording '" + (folder.path / "odd").string() + "'", "odd");
}

}  // namespace
