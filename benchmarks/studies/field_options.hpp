// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "field_methods.hpp"
#include "study_options.hpp"

// What the command lines of the field studies share.
namespace study {

struct FieldStudyOptions : Options {
  std::vector<std::string> readings;  ///< of the thesis' noise
  std::optional<std::uint64_t> fields;
};

inline void add_field_study_options(CLI::App& app, FieldStudyOptions& o) {
  add_study_options(app, o);
  app.add_option("--fields", o.fields, "Random fields to average over")->check(CLI::Range(1, 1000000))->type_name("N");
  std::string about_readings;
  for (const std::string& r : all_readings())
    about_readings += (about_readings.empty() ? "" : ". ") + r + ": " + about(r);
  app.add_option("--noise", o.readings, about_readings)
      ->delimiter(',')
      ->check(CLI::IsMember(all_readings()))
      ->default_str(CLI::detail::join(o.readings, ","))
      ->type_name("NAME,...");
}

}  // namespace study
