// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Hostile CSV, all the way to a world's truth: either it works, and what was read is sane, or vantage::Error says why.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/field_file.hpp>
#include <vantage/sim/sampled_field.hpp>

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

// Numbers that were read are finite or missing, one a row, and come back from a written file bit for bit.
void check_columns(const vantage::CsvTable& table) {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < table.columns(); ++i) {
    try {
      const auto column = table.column(i);
      require(column.size() == table.rows());
      for (const double v : column) require(std::isfinite(v) || std::isnan(v));
      names.push_back(vantage::concat("c", i));
      columns.emplace_back(column.begin(), column.end());
    } catch (const vantage::Error&) {  // text
    }
  }
  if (names.empty()) return;
  if (names.size() == 1) {  // a blank line is no row of a single column: let there be two
    names.push_back("one");
    columns.emplace_back(table.rows(), 1.0);
  }
  const vantage::CsvTable again = vantage::parse_csv(vantage::format_csv(names, columns));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = again.column(i);
    require(column.size() == columns[i].size());
    for (std::size_t row = 0; row < column.size(); ++row)
      require(column[row] == columns[i][row] || (std::isnan(column[row]) && std::isnan(columns[i][row])));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const vantage::CsvTable table = vantage::parse_csv(text);
    check_columns(table);
    const auto unit_of = [](const std::string& name) { return std::string(name == "deg" ? "deg" : ""); };
    const vantage::FieldSamples samples = vantage::field_samples(table, {}, unit_of);
    const vantage::SampledField field = vantage::sampled_field(samples, vantage::Rng(1), {.pixels = 24});
    require(std::isfinite(field.truth.minimum()) && std::isfinite(field.truth.maximum()));
    for (const vantage::FieldSample& s : field.held_out)
      require(std::isfinite(field.truth.at(s.position)) && std::isfinite(s.value));
  } catch (const vantage::Error& e) { require(*e.what() != '\0'); }
  return 0;
}
