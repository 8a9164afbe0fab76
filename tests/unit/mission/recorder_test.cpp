// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vantage/mission/recorder.hpp>
#include <vector>

#include "message_of.hpp"
#include "toy/folder.hpp"
#include "toy/mission.hpp"

namespace {

using namespace vantage;

constexpr auto metrics = [](const toy::ToyMap& map) {
  return std::vector<Metric>{{"variance", map.total_variance()},
                             {"undefined", std::numeric_limits<double>::quiet_NaN()}};
};
using Metrics = std::remove_const_t<decltype(metrics)>;
using Json = nlohmann::ordered_json;

Json parsed(const std::filesystem::path& file) { return Json::parse(read_file(file, std::size_t{1} << 30)); }

RecorderConfig config_in(const toy::Folder& folder) {
  return {.file = folder.path / "mission.json", .config = {{"resolution", 8}, {"method", "toy"}}, .seed = 5};
}

TEST(Recorder, WritesTheMission) {
  const toy::Folder folder;
  Recorder recorder(config_in(folder), metrics);
  auto loop = toy::toy_loop();
  toy::ToyWorld world;
  const std::vector<View> first = {nadir(1, 1, 1)};
  const MissionState end = loop.run(world, nadir(4, 4, 2), first, toy::ToyStop{20}, ModelledClock{}, Rng(5), recorder);

  const Json json = parsed(folder.path / "mission.json");
  EXPECT_EQ(json["config"]["resolution"], 8);
  EXPECT_EQ(json["seed"], 5);
  EXPECT_EQ(json["versions"]["vantage"], VANTAGE_VERSION);
  EXPECT_EQ(json["stop_reason"], "stop_rule");
  ASSERT_EQ(json["steps"].size(), end.visited.size() + 1);
  const Json& prior = json["steps"][0];
  EXPECT_EQ(prior["step"], 0);
  EXPECT_EQ(prior["view"]["position"], Json({4.0, 4.0, 2.0}));
  EXPECT_EQ(prior["view"]["forward"], Json({0.0, 0.0, -1.0}));
  EXPECT_EQ(prior["view"]["up"], Json({0.0, 1.0, 0.0}));
  EXPECT_EQ(prior["metrics"]["variance"], 64);
  EXPECT_TRUE(prior["metrics"]["undefined"].is_null());
  EXPECT_EQ(json["steps"][1]["planned"], false);
  EXPECT_TRUE(json["steps"][1]["utility"].is_null());

  double elapsed_s = 0, travelled_m = 0;
  for (std::size_t i = 1; i < json["steps"].size(); ++i) {
    const Json& step = json["steps"][i];
    EXPECT_EQ(step["step"], i);
    elapsed_s += step["planning_s"].get<double>() + step["mapping_s"].get<double>() + step["action_s"].get<double>();
    travelled_m += step["action_s"].get<double>();  // at 1 m/s
    EXPECT_NEAR(step["elapsed_s"].get<double>(), elapsed_s, 1e-9);
    EXPECT_NEAR(step["travelled_m"].get<double>(), travelled_m, 1e-9);
    if (i > 1) {
      EXPECT_EQ(step["candidates"], 8);
      EXPECT_EQ(step["utility"], step["best_utility"]);  // the toy's selector takes the best
    }
  }
  EXPECT_EQ(json["steps"].back()["metrics"]["variance"], loop.map.total_variance());  // the same double, not nearly
}

TEST(Recorder, WithoutPriorTheFirstViewsMakeStepZero) {
  Recorder recorder(RecorderConfig{.with_prior = false}, metrics);
  auto loop = toy::toy_loop();
  toy::ToyWorld world;
  const std::vector<View> first = {nadir(1, 1, 1), nadir(2, 2, 1), nadir(3, 3, 1)};
  loop.run(world, first[0], first, toy::ToyStop{10}, ModelledClock{}, Rng(5), recorder);
  const auto& steps = recorder.record().steps;
  ASSERT_GE(steps.size(), 3u);
  EXPECT_EQ(steps[0].index, 3u);
  EXPECT_FALSE(steps[0].planned);
  EXPECT_NEAR(steps[0].mapping_s, steps[0].elapsed_s, 1e-12);  // of all three
  EXPECT_GT(steps[0].mapping_s, 2.5 * steps[1].mapping_s);
  EXPECT_EQ(steps[1].index, 4u);
  EXPECT_TRUE(steps[1].planned);
}

TEST(Recorder, SaysWhyItStopped) {
  Recorder recorder(RecorderConfig{}, metrics);
  auto loop = toy::toy_loop();
  toy::ToyWorld world{.ends_after = 3};
  loop.run(world, nadir(4, 4, 2), {}, toy::ToyStop{1e9}, ModelledClock{}, Rng(5), recorder);
  EXPECT_EQ(recorder.record().reason, StopReason::world_ended);
  EXPECT_EQ(recorder.record().steps.size(), 4u);
}

TEST(Recorder, ARunMissionIsUnfinishedInTheFileUntilItEnds) {
  const toy::Folder folder;
  Recorder recorder(RecorderConfig{.file = folder.path / "mission.json", .write_every_s = 0}, metrics);
  struct Look {
    std::filesystem::path file;
    int seen = 0;
    void measured(const toy::ToyMap&, const Situation& q, const Step<FieldImage>&) {
      const Json json = parsed(file);
      EXPECT_TRUE(json["stop_reason"].is_null());
      EXPECT_EQ(json["steps"].size(), q.step + 1);
      ++seen;
    }
  } look{folder.path / "mission.json"};
  auto loop = toy::toy_loop();
  toy::ToyWorld world;
  loop.run(world, nadir(4, 4, 2), {}, toy::ToyStop{10}, ModelledClock{}, Rng(5), recorder, look);
  EXPECT_GT(look.seen, 2);
}

Recorder<Metrics> recorded(const RecorderConfig& config) {
  Recorder recorder(config, metrics);
  auto loop = toy::toy_loop();
  toy::ToyWorld world;
  loop.run(world, nadir(4, 4, 2), {}, toy::ToyStop{10}, ModelledClock{}, Rng(5), recorder);
  return recorder;
}

TEST(Recorder, RestoresTheSameBytes) {
  const RecorderConfig config{.config = {{"resolution", 8}}, .seed = 5};
  const auto recorder = recorded(config);
  Sink sink;
  recorder.save(sink);
  Recorder other(config, metrics);
  Source source(sink.bytes());
  other.load(source);
  source.done();
  MissionRecord expected = recorder.record();
  expected.reason.reset();  // a restored mission goes on
  EXPECT_EQ(mission_json(other.record()), mission_json(expected));
}

TEST(Recorder, NamesThatAreNoUtf8AreRecorded) {
  const toy::Folder folder;
  RecorderConfig config = config_in(folder);
  config.config["quantity"] = "temp\xE9rature";  // Latin-1
  const auto recorder = recorded(config);
  EXPECT_EQ(parsed(config.file)["config"]["quantity"], "temp\uFFFDrature");
  Sink sink;
  recorder.save(sink);
  Recorder same(config, metrics);
  Source source(sink.bytes());
  EXPECT_NO_THROW(same.load(source));
  config.config["resolution"] = 9;
  Recorder other(config, metrics);
  Source again(sink.bytes(), "old");
  EXPECT_REFUSED((other.load(again), 0), "other options (resolution: 8 there, 9 here)");
}

TEST(Recorder, RefusesAnotherMissionsRecordAndKeepsItsOwn) {
  const auto recorder = recorded({.config = {{"resolution", 8}, {"method", "ours"}}, .seed = 5});
  Sink sink;
  recorder.save(sink);
  Recorder other(RecorderConfig{.config = {{"resolution", 16}, {"sensor", "wide"}}, .seed = 5}, metrics);
  Source source(sink.bytes(), "old.checkpoint");
  try {
    other.load(source);
    FAIL() << "accepted";
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("resolution: 8 there, 16 here"), text.npos) << text;
    EXPECT_NE(text.find("method: \"ours\" there, none here"), text.npos) << text;
    EXPECT_NE(text.find("sensor: none there, \"wide\" here"), text.npos) << text;
  }
  EXPECT_TRUE(other.record().steps.empty());
  Recorder seeded(RecorderConfig{.config = recorder.record().config, .seed = 6}, metrics);
  Source again(sink.bytes());
  EXPECT_THROW(seeded.load(again), Error);
}

TEST(Recorder, RefusesEveryTruncation) {
  const auto recorder = recorded({.seed = 5});
  Sink sink;
  recorder.save(sink);
  Recorder other(RecorderConfig{.seed = 5}, metrics);
  for (std::size_t n = 0; n < sink.bytes().size(); n += 7) {
    Source source(sink.bytes().first(n));
    EXPECT_THROW(other.load(source), Error) << n;
    EXPECT_TRUE(other.record().steps.empty());
  }
}

TEST(Recorder, RefusesABadConfig) {
  EXPECT_THROW(Recorder(RecorderConfig{.config = Json::array()}, metrics), Error);
  EXPECT_THROW(Recorder(RecorderConfig{.write_every_s = -1}, metrics), Error);
  EXPECT_THROW(Recorder(RecorderConfig{.write_every_s = std::nan("")}, metrics), Error);
}

}  // namespace
