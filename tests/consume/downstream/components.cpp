// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// The optional components, as somebody else's program uses them: a simulated field, a file of it, a record of the
// mission.
#include <cstdio>

#include <vantage/io/npy.hpp>
#include <vantage/mission/record.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/vantage.hpp>

int main() {
  const vantage::ScalarField field = vantage::random_field(vantage::Rng{1});
  const auto bytes = vantage::encode_npy(field.values());
  std::printf("%zu bytes, %s\n", bytes.size(), vantage::versions().dump().c_str());
  return bytes.size() > static_cast<std::size_t>(field.values().size()) * sizeof(double) ? 0 : 1;
}
