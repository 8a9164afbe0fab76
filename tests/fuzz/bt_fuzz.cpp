// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as an OctoMap .bt file: refused with an Error, or a tree whose leaves are where it says, and which is read
// as the same when it is written again.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/octomap_bt.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    const OccupancyOctree tree = decode_bt(bytes, "input", {.bytes = 1 << 20, .leaves = 1 << 16});
    if (!(decode_bt(encode_bt(tree), "again") == tree)) std::abort();
    const bool ordinary = tree.voxel_m() > 1e-6 && tree.voxel_m() < 1e6;  // else the centres themselves overflow
    for (const OccupancyOctree::Leaf& leaf : tree.leaves())
      if (ordinary && tree.at(tree.box_of(leaf).center()) != leaf.space) std::abort();
  } catch (const Error&) {}
  return 0;
}
