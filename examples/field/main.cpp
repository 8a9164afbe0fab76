// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A UAV plans where to measure a field, so that what lies above a threshold is known well, soon (chapter 3 of the
// thesis). What a mission is made of, and in which lines the methods differ: mission.hpp.
#include <iostream>

#include "input.hpp"
#include "mission.hpp"
#include "options.hpp"

namespace {

void run(const field::Options& o) {
  field::validate(o);
  vantage::make_folder(o.out);
  const field::Input input = field::load(o);
  std::cerr << field::words(input.name) << ". " << input.note << '\n';
  if (o.preset == vantage::PresetKind::thesis)
    field::Mission<vantage::preset::thesis>(o, input).run();
  else
    field::Mission<vantage::preset::reference>(o, input).run();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A UAV plans where to measure a field, and maps it.", "field");
  field::Options options;
  options.command.assign(argv, argv + argc);
  field::add_options(app, options);
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { run(options); }); });
}
