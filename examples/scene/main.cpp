// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A robot sees a scene for the first time: it reconstructs a home with surfels or explores it (chapter 6), or looks at
// objects or through a recording from given views.
#include <iostream>

#include "missions.hpp"

namespace {

void run(const scene::Options& o) {
  scene::validate(o);
  const scene::Input input = scene::load(o);
  vantage::make_folder(o.out);  // nothing is made of bad input
  std::cerr << input.name << (input.note.empty() ? "" : ": ") << input.note << '\n';
  scene::fly_mission(o, input, std::cerr);
  std::cout << (o.out / "report.html").string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A robot explores a scene, or looks around in it, and reconstructs it.", "scene");
  scene::Options options;
  options.command.assign(argv, argv + argc);
  scene::add_options(app, options);
  app.get_option("--preset")->default_str("reference of surfels, else thesis");
  return vantage::run_program(app, argc, argv, std::cout, std::cerr, [&] {
    // Of surfels, the preset that reconstructs better.
    if (app.count("--preset") == 0 && options.reconstructs()) options.preset = vantage::PresetKind::reference;
    vantage::with_threads(options.threads, [&] { run(options); });
  });
}
