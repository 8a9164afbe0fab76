// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "../../../benchmarks/studies/units.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "temporary_folder.hpp"

namespace study {
namespace {

std::vector<Unit> some_units(int n, int seed = 1) {
  std::vector<Unit> units;
  for (int i = 0; i < n; ++i) units.push_back({"unit_" + std::to_string(i), {{"index", i}, {"seed", seed}}});
  return units;
}

std::string message(auto&& f) {
  try {
    f();
  } catch (const vantage::Error& e) { return e.what(); }
  return "";
}

class UnitsTest : public testing::Test {
 protected:
  vantage::test::TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path() / "units";
  std::ostringstream log_;
};

TEST_F(UnitsTest, EachUnitRunsOnceAndItsResultIsKept) {
  const Units store(folder_);
  const std::vector<Unit> units = some_units(5);
  std::vector<int> ran;
  const auto work = [&](const Unit& u) {
    ran.push_back(u.parameters["index"]);
    return Json{{"square", u.parameters["index"].get<int>() * u.parameters["index"].get<int>()}};
  };
  EXPECT_EQ(store.run(units, {}, log_, work), 5u);
  EXPECT_EQ(store.run(units, {}, log_, work), 0u);
  EXPECT_EQ(Units(folder_).run(units, {}, log_, work), 0u);
  EXPECT_EQ(ran, (std::vector{0, 1, 2, 3, 4}));
  EXPECT_GE(store.busiest(units), 0);
  for (int i = 0; i < 5; ++i) EXPECT_EQ((*store.result(units[static_cast<std::size_t>(i)]))["square"], i * i);
}

TEST_F(UnitsTest, GoesOnAfterAFailureWhereItStopped) {
  const Units store(folder_);
  const std::vector<Unit> units = some_units(4);
  EXPECT_THROW(store.run(units, {}, log_,
                         [](const Unit& u) {
                           if (u.parameters["index"] == 2) throw std::runtime_error("power cut");
                           return Json{{"value", 1}};
                         }),
               std::runtime_error);
  EXPECT_TRUE(store.result(units[1]));
  EXPECT_FALSE(store.result(units[2]));
  std::vector<int> ran;
  store.run(units, {}, log_, [&](const Unit& u) {
    ran.push_back(u.parameters["index"]);
    return Json{{"value", 2}};
  });
  EXPECT_EQ(ran, (std::vector{2, 3}));
  EXPECT_EQ((*store.result(units[0]))["value"], 1);
}

TEST_F(UnitsTest, ShardsShareTheWorkWithoutOverlap) {
  const std::vector<Unit> units = some_units(11);
  std::vector<int> times(11, 0);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    Units(folder_).run(units, Shard::parse(shard), log_, [&](const Unit& u) {
      ++times[u.parameters["index"].get<std::size_t>()];
      return Json{{"shard", shard}};
    });
  EXPECT_EQ(times, std::vector(11, 1));
  EXPECT_EQ((*Units(folder_).result(units[4]))["shard"], "2/3");
}

TEST_F(UnitsTest, ProcessesThatShareAFolderTakeTurns) {
  const std::vector<Unit> units = some_units(20);
  std::atomic<int> inside = 0, most = 0, ran = 0;
  const auto work = [&] {
    std::ostringstream log;
    Units(folder_).run(units, {}, log, [&](const Unit&) {
      most = std::max(most.load(), ++inside);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      --inside;
      ++ran;
      return Json{{"value", 1}};
    });
  };
  std::thread one(work), two(work);  // flock knows open files, not threads: as two processes
  one.join();
  two.join();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(ran, 20);
}

TEST_F(UnitsTest, ResultsOfOtherParametersAreRefused) {
  const Units store(folder_);
  store.run(some_units(1, 1), {}, log_, [](const Unit&) { return Json{{"value", 1}}; });
  const std::string what = message([&] {
    store.run(some_units(1, 2), {}, log_, [](const Unit&) { return Json{{"value", 2}}; });
  });
  EXPECT_NE(what.find("unit_0.json"), what.npos) << what;
  EXPECT_NE(what.find("\"seed\":1"), what.npos) << what;
  EXPECT_NE(what.find("--out"), what.npos) << what;
}

TEST_F(UnitsTest, DamagedResultsAreRefused) {
  const Units store(folder_);
  for (const char* text : {"", "{\"parameters\": {\"index\"", "[]", "{\"parameters\": 1}"}) {
    std::ofstream(folder_ / "unit_0.json", std::ios::trunc) << text;
    EXPECT_NE(message([&] { (void)store.result(some_units(1)[0]); }).find("no result of a unit"), std::string::npos)
        << text;
  }
}

TEST_F(UnitsTest, AHalfWrittenFileIsNoResult) {
  const Units store(folder_);
  std::ofstream(folder_ / "unit_0.json.part") << "{\"para";
  EXPECT_FALSE(store.result(some_units(1)[0]));
}

TEST_F(UnitsTest, NamesMustBeGoodAndDifferent) {
  const Units store(folder_);
  const auto run = [&](const std::vector<Unit>& units) {
    return message([&] { store.run(units, {}, log_, [](const Unit&) { return Json{}; }); });
  };
  EXPECT_NE(run({{"a", {}}, {"a", {}}}), "");
  EXPECT_NE(run({{"../a", {}}}), "");
  EXPECT_NE(run({{"", {}}}), "");
  EXPECT_NE(run({{".alone", {}}}), "");
}

TEST(Shard, Parses) {
  EXPECT_EQ(Shard::parse("1/1").count, 1u);
  EXPECT_EQ(Shard::parse("2/8").index, 1u);
  for (const char* bad :
       {"", "1", "/", "0/2", "3/2", "1/0", "-1/2", "1/2/3", "1 /2", "a/b", "1/65537", "99999999999999999999/2"})
    EXPECT_THROW((void)Shard::parse(bad), vantage::Error) << bad;
}

}  // namespace
}  // namespace study
