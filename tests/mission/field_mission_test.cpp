// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vantage/io/file.hpp>
#include <vector>

#include "mission_program.hpp"

// The program examples/field, as its users start it.
namespace {

using namespace vantage;

nlohmann::json mission(const std::filesystem::path& out) {
  return nlohmann::json::parse(text_of(out / "mission.json"));
}

class FieldMission : public MissionProgram {
 protected:
  FieldMission() : MissionProgram("field") {}
  [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder.path / name) << text;
    return " --field '" + (folder.path / name).string() + "'";
  }
};

const std::string quick = "--random 1 --resolution 16 --measurements 5 --clock modelled";

TEST_F(FieldMission, LeavesWhatItPromises) {
  const Ended e = run(quick + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto a = folder.path / "a";
  EXPECT_EQ(e.out, (a / "report.html").string() + "\n");
  EXPECT_NE(e.err.find("step 5  "), e.err.npos);

  const auto json = mission(a);
  EXPECT_EQ(json["stop_reason"], "stop_rule");
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["config"]["method"], "ours");
  ASSERT_EQ(json["steps"].size(), 6u);
  EXPECT_EQ(json["steps"][0]["metrics"]["cells"], 256);
  for (const auto& step : json["steps"])
    for (const char* metric : {"rmse", "rmse_hotspots", "iou", "cells"}) EXPECT_TRUE(step["metrics"].contains(metric));
  EXPECT_LT(json["steps"][5]["metrics"]["rmse_hotspots"], json["steps"][0]["metrics"]["rmse_hotspots"]);
  EXPECT_EQ(json["steps"][5]["candidates"].get<int>() > 200, true);

  for (const char* picture : {"truth.png", "map.png", "decompressed.png", "path.png", "uncertainty.png", "error.png"})
    EXPECT_EQ(text_of(a / picture).substr(1, 3), "PNG") << picture;
  const std::string cells = text_of(a / "cells.csv");
  EXPECT_EQ(std::count(cells.begin(), cells.end(), '\n'), json["steps"][5]["metrics"]["cells"].get<int>() + 1);
  EXPECT_EQ(text_of(a / "mean.npy").substr(1, 5), "NUMPY");
  const std::string report = text_of(a / "report.html");
  EXPECT_NE(report.find("</html>"), report.npos);
  EXPECT_NE(report.find("data:image/png;base64,iVBOR"), report.npos);
}

TEST_F(FieldMission, TheSameSeedGivesTheSameBytesWithAnyThreads) {
  ASSERT_EQ(run(quick + " --threads 1" + out("a")).code, 0);
  ASSERT_EQ(run(quick + " --threads 2" + out("b")).code, 0);
  ASSERT_EQ(run(quick + " --seed 8" + out("c")).code, 0);
  for (const char* name : {"mission.json", "cells.csv", "mean.npy", "deviation.npy", "map.png", "error.png"})
    EXPECT_EQ(text_of(folder.path / "a" / name), text_of(folder.path / "b" / name)) << name;
  EXPECT_NE(text_of(folder.path / "a" / "cells.csv"), text_of(folder.path / "c" / "cells.csv"));
}

TEST_F(FieldMission, KilledAndResumed) {
  const std::string longer = "--random 1 --resolution 16 --measurements 60 --clock modelled --checkpoint 0";
  ASSERT_EQ(run(longer + out("whole")).code, 0);
  int kills = 0;
  for (double wait_s = 0.1; kills < 4; wait_s *= 1.3) {
    const ::pid_t pid = start(longer + " --resume" + out("broken"));
    std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    ::kill(pid, SIGKILL);
    int status = 0;
    ::waitpid(pid, &status, 0);
    if (WIFEXITED(status)) break;
    ++kills;
  }
  EXPECT_GE(kills, 1);
  const Ended e = run(longer + " --resume" + out("broken"));
  ASSERT_EQ(e.code, 0) << e.err;
  for (const char* name : {"mission.json", "cells.csv", "mean.npy"})
    EXPECT_EQ(text_of(folder.path / "whole" / name), text_of(folder.path / "broken" / name)) << name;
}

TEST_F(FieldMission, ResumingAnotherMissionIsRefused) {
  ASSERT_EQ(run(quick + " --checkpoint 0" + out("a")).code, 0);
  const std::string before = text_of(folder.path / "a" / "mission.json");
  const Ended e = run(quick + " --threshold 0.5 --resume" + out("a"));
  EXPECT_EQ(e.code, 2);
  EXPECT_NE(e.err.find("threshold: 0.7 there, 0.5 here"), e.err.npos) << e.err;
  EXPECT_EQ(text_of(folder.path / "a" / "mission.json"), before);
}

TEST_F(FieldMission, EveryMethodAndPresetRuns) {
  const std::string list = run("--list-methods").out;
  std::istringstream lines(list);
  int methods = 0;
  for (std::string line; std::getline(lines, line); ++methods)
    for (const char* preset : {"thesis", "reference"}) {
      const std::string method = line.substr(0, line.find(' '));
      const Ended e = run("--random 1 --resolution 16 --measurements 3 --clock modelled --method " + method +
                          " --preset " + preset + out(method));
      ASSERT_EQ(e.code, 0) << method << ' ' << preset << ": " << e.err;
      EXPECT_EQ(mission(folder.path / method)["steps"].size(), 4u) << method;
    }
  EXPECT_EQ(methods, 9);
}

TEST_F(FieldMission, TheProtocolOfFigure35) {
  const Ended e = run(
      "--random 1 --resolution 16 --protocol lawnmower81 --budget 1000 --threshold 0.6 --clock modelled" + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto json = mission(folder.path / "a");
  EXPECT_EQ(json["steps"].size(), 82u);
  EXPECT_EQ(json["config"]["threshold"], 0.6);
  EXPECT_EQ(json["stop_reason"], "nothing_to_do");
  EXPECT_FALSE(json["config"].contains("scale_m_per_unit"));
}

// A plane in the unit of a table, on a grid with a hole and scattered.
std::string plane(bool gridded) {
  std::string csv = "x,y,other,level\n";
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 9; ++j) {
      const double x = i + (gridded ? 0 : 0.3 * std::sin(7.0 * i + 3.0 * j)),
                   y = j + (gridded ? 0 : 0.3 * std::cos(5.0 * i + 11.0 * j));
      const bool hole = gridded && i > 7 && j > 5;
      csv += std::to_string(x) + "," + std::to_string(y) + ",1," + (hole ? "" : std::to_string(1000 + 10 * x + 5 * y)) +
             "\n";
    }
  return csv;
}

TEST_F(FieldMission, FieldsFromFilesInTheirOwnUnit) {
  for (const bool gridded : {true, false}) {
    const std::string name = gridded ? "grid" : "scattered";
    const Ended e = run("--resolution 16 --budget 120 --clock modelled --column level" +
                        file(name + ".csv", plane(gridded)) + out(name));
    ASSERT_EQ(e.code, 0) << e.err;
    const auto json = mission(folder.path / name);
    EXPECT_NEAR(json["config"]["range"][0].get<double>(), 1000, 10);
    const auto& last = json["steps"].back()["metrics"];
    EXPECT_LT(last["rmse_hotspots"], 12) << name;  // of a range of 150
    EXPECT_GT(last["iou"], 0.7) << name;
  }
}

TEST_F(FieldMission, AProtocolOverAFileSaysHowItsPlaceBecameTheFlightArea) {
  const Ended e = run("--resolution 8 --protocol lawnmower16 --budget 1000 --clock modelled" +
                      file("grid.csv", plane(true)) + out("grid"));
  ASSERT_EQ(e.code, 0) << e.err;
  const auto json = mission(folder.path / "grid");
  EXPECT_EQ(json["steps"].size(), 17u);
  EXPECT_EQ(json["stop_reason"], "nothing_to_do");
  EXPECT_NEAR(json["config"]["scale_m_per_unit"].get<double>(), 20.0 / 11, 1e-12);
  EXPECT_EQ(json["config"]["held_out_samples"], 0);
  EXPECT_FALSE(json["config"].contains("scale_latitude_deg"));
  const std::string report = text_of(folder.path / "grid" / "report.html");
  EXPECT_NE(report.find("both axes by the same scale: 1.82 m per unit of their positions."), report.npos);
}

TEST_F(FieldMission, SamplesWithoutOneBetweenTheOthersToHoldOut) {
  std::string csv = "v,Longitude,Latitude\n";  // a circle: the hull of any of them holds none of the others
  for (int i = 0; i < 6; ++i) csv += concat(i, ",", 10 + std::cos(1.0 + i), ",", 60 + 0.5 * std::sin(1.0 + i), "\n");
  const Ended e = run("--resolution 8 --measurements 2 --clock modelled" + file("circle.csv", csv) + out("circle"));
  ASSERT_EQ(e.code, 0) << e.err;
  EXPECT_NE(e.err.find("measured against this interpolation: no held-out sample lies between the others."), e.err.npos)
      << e.err;
  EXPECT_NE(e.err.find("m per degree of latitude, where x is longitude times the cosine of 60"), e.err.npos) << e.err;
  const auto config = mission(folder.path / "circle")["config"];
  EXPECT_EQ(config["held_out_samples"], 0);
  EXPECT_NEAR(config["scale_latitude_deg"].get<double>(), 60, 0.1);
}

TEST_F(FieldMission, NamesInLatin1) {
  const Ended e =
      run("--resolution 8 --measurements 2 --clock modelled" +
          file("temp\xE9.csv", "x,y,temp\xE9rature\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n0.4,0.5,2\n0.6,0.3,1\n") + out("a"));
  ASSERT_EQ(e.code, 0) << e.err;
  EXPECT_EQ(mission(folder.path / "a")["config"]["quantity"], "temp\uFFFDrature");
}

TEST_F(FieldMission, BadUsageAndBadInputAreOneLineAndExitCodeTwo) {
  const std::vector<std::string> bad = {"--method magic",
                                        "--resolution 33",
                                        "--random x",
                                        "--random -1",
                                        "--budget 0",
                                        "--threshold nan",
                                        "--threads -1",
                                        "--pixels 0",
                                        "--half-angle 90",
                                        "--field /nowhere/at/all.csv",
                                        "--random 1 --field x.csv",
                                        "--column level",
                                        "stray",
                                        "--side inf",
                                        "--side nan",
                                        "--half-angle nan",
                                        "--checkpoint nan",
                                        "--noise nan",
                                        "--protocol 1",
                                        "--random 1 --resolution 256",
                                        "--random 99999999999999999999999",
                                        "--noise -1",
                                        "--out /dev/null/x",
                                        file("text.csv", "this is no table"),
                                        file("empty.csv", ""),
                                        file("nan.csv", "x,y,v\n1,1,nan\n2,2,inf\n"),
                                        file("short.csv", "x,y,v\n1,1,1\n"),
                                        file("line.csv", "x,y,v\n0,0,1\n1,1,2\n2,2,3\n3,3,4\n4,4,5\n"),
                                        file("columns.csv", plane(true)) + " --column none"};
  for (const std::string& arguments : bad) {
    const Ended e = run(arguments + (arguments.find("--out") == arguments.npos ? out("bad") : ""));
    EXPECT_EQ(e.code, 2) << arguments << ": " << e.err;
    EXPECT_EQ(std::count(e.err.begin(), e.err.end(), '\n'), 1) << e.err;
    EXPECT_EQ(e.err.find("field: "), 0u) << e.err;
  }
}

}  // namespace
