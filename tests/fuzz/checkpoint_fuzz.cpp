// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a checkpoint: refused with an Error and nothing changed, or loaded whole. The input is tried as it is,
// once more with its checksum made right, so that what lies behind the checksum is reached too, and as bits to flip in
// a good checkpoint, so that the corpus stays of use when the layout changes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>
#include <vantage/loop/clocks.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/mission/checkpoint.hpp>
#include <vantage/mission/recorder.hpp>
#include <vector>

namespace {

using namespace vantage;

struct Mission {
  IntegralGp<> map{{.tree = {.depth = 2}}};
  ModelledClock clock;
  MissionState state{.here = nadir(1, 1, 1), .rng = Rng(5)};
  Recorder<std::vector<Metric> (*)(const IntegralGp<>&)> recorder{RecorderConfig{.seed = 5}, nullptr};

  [[nodiscard]] std::vector<std::byte> bytes() const { return checkpoint_bytes(recorder, state, clock, map); }
};

void try_to_load(std::span<const std::byte> bytes) {
  static const std::vector<std::byte> fresh = Mission().bytes();
  Mission mission;
  try {
    restore_checkpoint(bytes, "input", mission.recorder, mission.state, mission.clock, mission.map);
  } catch (const Error&) {
    if (mission.bytes() != fresh) std::abort();  // refused, and yet something changed
    return;
  }
  Mission again;  // what was accepted can be saved and loaded
  const std::vector<std::byte> accepted = mission.bytes();
  restore_checkpoint(accepted, "accepted", again.recorder, again.state, again.clock, again.map);
  if (again.bytes() != accepted) std::abort();
}

std::vector<std::byte> with_right_checksum(std::vector<std::byte> bytes) {
  const std::size_t body = bytes.size() - sizeof(std::uint64_t);
  const std::uint64_t sum = fnv1a(std::span(bytes).first(body));
  std::memcpy(bytes.data() + body, &sum, sizeof sum);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  if (size != 0) std::memcpy(bytes.data(), data, size);
  try_to_load(bytes);
  if (size >= sizeof(std::uint64_t)) try_to_load(with_right_checksum(bytes));
  std::vector<std::byte> altered = Mission().bytes();
  for (std::size_t i = 0; i < std::min(size, altered.size()); ++i) altered[i] ^= bytes[i];
  try_to_load(with_right_checksum(std::move(altered)));
  return 0;
}
