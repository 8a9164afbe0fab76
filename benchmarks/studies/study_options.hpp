// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <vantage/mission/command_line.hpp>

#include "units.hpp"

// What the command lines of all studies share.
namespace study {

struct Options {
  std::filesystem::path out;
  std::vector<std::string> methods;
  std::uint64_t seed = 7;
  int threads = 0;
  std::string shard;
  bool merge = false, quick = false;

  [[nodiscard]] std::filesystem::path units() const { return out / "units"; }
};

inline void add_study_options(CLI::App& app, Options& o) {
  std::vector<std::string> names;
  for (const std::string& m : o.methods) names.push_back(m);
  app.set_version_flag("--version", "vantage " VANTAGE_VERSION);
  app.add_option("--out", o.out, "Folder of the results; what has been measured there is not measured again")
      ->take_last()
      ->capture_default_str()
      ->type_name("DIR");
  app.add_option("--methods", o.methods, "Methods, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->default_str(CLI::detail::join(names, ","))
      ->type_name("NAME,...");
  app.add_option("--seed", o.seed, "Seed of everything random")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--threads", o.threads, "Threads of a unit of work; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str()
      ->type_name("N");
  auto* shard = app.add_option("--shard", o.shard,
                               "Run only every n-th unit of work, from the i-th on, and make no tables: for job arrays")
                    ->type_name("i/n");
  app.add_flag("--merge", o.merge, "Run nothing: make the tables of the units that there are")->excludes(shard);
  app.add_flag("--quick", o.quick, "A small part of the study, in about a minute");
}

/// Runs the units that are missing (or this shard's) and then, unless it is a shard, makes the tables by `tables()`.
template <class Run, class Tables>
void run_study(const Options& o, const std::vector<Unit>& units, std::ostream& log, Run&& run, Tables&& tables) {
  const Shard shard = o.shard.empty() ? Shard{} : Shard::parse(o.shard);
  vantage::make_folder(o.out);
  const Units store(o.units());
  if (!o.merge) store.run(units, shard, log, run);
  if (o.shard.empty()) return tables(store);
  log << "this shard is done; run again with --merge and without --shard to make the tables" << std::endl;
}

}  // namespace study
