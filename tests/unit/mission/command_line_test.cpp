// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vantage/core/parallel.hpp>
#include <vantage/mission/command_line.hpp>
#include <vector>

#include "toy/folder.hpp"

namespace {

using namespace vantage;

struct Result {
  int code;
  std::string out, err;
  MissionOptions options;
};

template <class F>
Result run(std::vector<const char*> words, F&& f) {
  Result r{};
  r.options.out = "out/toy";
  CLI::App app("A toy mission", "toy");
  add_mission_options(app, r.options, {{"ours", "the best one"}, {"random", "a baseline"}});
  std::ostringstream out, err;
  words.insert(words.begin(), "toy");
  r.code = run_program(app, static_cast<int>(words.size()), words.data(), out, err, f);
  r.out = out.str();
  r.err = err.str();
  return r;
}
Result run(const std::vector<const char*>& words) {
  return run(words, [] {});
}

TEST(CommandLine, Defaults) {
  const Result r = run({});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(r.options.out, "out/toy");
  EXPECT_EQ(r.options.method, "ours");
  EXPECT_EQ(r.options.clock, ClockKind::real);
  EXPECT_FALSE(r.options.resume);
  EXPECT_TRUE(std::isinf(r.options.budget_s));
}

TEST(CommandLine, ReadsEveryOption) {
  const Result r =
      run({"--out", "a/b", "--seed", "11", "--threads", "2", "--method", "random", "--preset", "reference", "--clock",
           "modelled", "--budget", "300.5", "--measurements", "16", "--travel", "80", "--resume"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(r.options.out, "a/b");
  EXPECT_EQ(r.options.seed, 11u);
  EXPECT_EQ(r.options.threads, 2);
  EXPECT_EQ(r.options.method, "random");
  EXPECT_EQ(r.options.preset, PresetKind::reference);
  EXPECT_EQ(r.options.clock, ClockKind::modelled);
  EXPECT_EQ(r.options.budget_s, 300.5);
  EXPECT_EQ(r.options.measurements, 16u);
  EXPECT_EQ(r.options.travel_m, 80);
  EXPECT_TRUE(r.options.resume);
}

TEST(CommandLine, BadUsageIsOneLineAndExitCodeTwo) {
  const std::vector<std::vector<const char*>> bad = {{"--method", "magic"},
                                                     {"--clock", "sundial"},
                                                     {"--preset", "mine"},
                                                     {"--budget", "0"},
                                                     {"--budget", "-5"},
                                                     {"--budget", "nan"},
                                                     {"--budget", "inf"},
                                                     {"--budget", "12s"},
                                                     {"--budget", ""},
                                                     {"--measurements", "0"},
                                                     {"--measurements", "-1"},
                                                     {"--travel", "0"},
                                                     {"--threads", "-1"},
                                                     {"--threads", "x"},
                                                     {"--seed", "x"},
                                                     {"--seed", "-1"},
                                                     {"--seed", "99999999999999999999999"},
                                                     {"--clock", "1"},
                                                     {"--preset", "0"},
                                                     {"--seed"},
                                                     {"--unknown"},
                                                     {"stray"}};
  for (const auto& words : bad) {
    bool ran = false;
    const Result r = run(words, [&] { ran = true; });
    const std::string what = words[0] + std::string(" ") + words.back();
    EXPECT_EQ(r.code, 2) << what;
    EXPECT_FALSE(ran) << what;
    EXPECT_EQ(r.out, "") << what;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_EQ(r.err.find("toy: "), 0u) << r.err;
    EXPECT_NE(r.err.find(words[0][0] == '-' && words[0] != std::string("--unknown") ? words[0] : words.back()),
              std::string::npos)
        << r.err;
  }
}

TEST(CommandLine, SaysWhatWasExpected) {
  EXPECT_EQ(run({"--clock", "slow"}).err, "toy: --clock: 'slow' is none of real, modelled (see --help)\n");
  EXPECT_EQ(run({"--preset", "0"}).err, "toy: --preset: '0' is none of thesis, reference (see --help)\n");
  EXPECT_EQ(run({"--seed", "18446744073709551616"}).err,
            "toy: --seed: '18446744073709551616' is no whole number up to 18446744073709551615 (see --help)\n");
  EXPECT_EQ(run({"--seed", "18446744073709551615"}).options.seed, std::numeric_limits<std::uint64_t>::max());
}

TEST(CommandLine, NumbersInARangeAreFinite) {
  const CLI::Validator half = detail::between(-0.5, 80);
  for (const char* good : {"-0.5", "0", "1e1", "80"}) EXPECT_EQ(half(std::string(good)), "") << good;
  for (const char* bad : {"nan", "inf", "-inf", "81", "-0.6", "", "1x", "x"})
    EXPECT_EQ(half(std::string(bad)), concat("'", bad, "' is no number from -0.5 to 80"));
}

TEST(CommandLine, HelpAndVersionAndMethodsEndWell) {
  for (const char* word : {"--help", "--version", "--list-methods"}) {
    bool ran = false;
    const Result r = run({word}, [&] { ran = true; });
    EXPECT_EQ(r.code, 0) << word;
    EXPECT_FALSE(ran) << word;
    EXPECT_EQ(r.err, "") << word;
    EXPECT_NE(r.out, "") << word;
  }
  EXPECT_EQ(run({"--version"}).out, "vantage " VANTAGE_VERSION "\n");
  EXPECT_EQ(run({"--list-methods"}).out, "ours    the best one\nrandom  a baseline\n");
  const std::string help = run({"--help"}).out;
  for (const char* option : {"--out", "--seed", "--threads", "--clock", "--preset", "--method", "--list-methods",
                             "--budget", "--measurements", "--travel", "--resume", "out/toy", "real", "thesis"})
    EXPECT_NE(help.find(option), std::string::npos) << option;
  EXPECT_EQ(help.find("->"), std::string::npos) << help;  // no enumerators behind the names
}

TEST(CommandLine, ExitCodes) {
  const auto result_of = [](auto f) { return run({}, f); };
  EXPECT_EQ(result_of([] { throw Error("field.csv:3", "x = nan", "finite"); }).code, 2);
  EXPECT_EQ(result_of([] { throw Error("field.csv:3", "x = nan", "finite"); }).err,
            "toy: field.csv:3: x = nan; expected finite\n");
  EXPECT_EQ(result_of([] { throw std::runtime_error("two\nlines\n"); }).code, 1);
  EXPECT_EQ(result_of([] { throw std::runtime_error("two\nlines\n"); }).err, "toy: two lines\n");
  EXPECT_EQ(result_of([] { throw std::bad_alloc(); }).err, "toy: out of memory\n");
  EXPECT_EQ(result_of([] { throw 1; }).code, 1);
}

TEST(CommandLine, ThreadsLimitParallelWork) {
  const auto threads = [] { return tbb::this_task_arena::max_concurrency(); };
  EXPECT_EQ(with_threads(1, threads), 1);
  EXPECT_EQ(with_threads(0, threads), tbb::info::default_concurrency());
  EXPECT_EQ(with_threads(1000, threads), tbb::info::default_concurrency());
}

TEST(CommandLine, MakesFoldersOrSaysWhyNot) {
  const toy::Folder folder;
  make_folder(folder.path / "a" / "b");
  make_folder(folder.path / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder.path / "a" / "b"));
  std::ofstream(folder.path / "file") << "x";
  EXPECT_THROW(make_folder(folder.path / "file"), Error);
  EXPECT_THROW(make_folder(folder.path / "file" / "c"), Error);
}

}  // namespace
