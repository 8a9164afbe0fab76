// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a .npy file, and as an archive of them: refused with an Error, or read so that what is written again is
// read as the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/npz.hpp>

namespace {

using namespace vantage;

constexpr TensorLimits limits{.bytes = 1 << 20, .axes = 8, .tensors = 16};

std::string text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}
bool same(const Tensor& a, const Tensor& b) { return a.type == b.type && a.shape == b.shape && a.bytes == b.bytes; }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    const Tensor tensor = decode_npy(bytes, "input", limits);
    if (!same(decode_npy(text(encode_npy(tensor)), "again"), tensor)) std::abort();
    static_cast<void>(tensor.values<std::int16_t>("input"));
  } catch (const Error&) {}
  try {
    const Tensors tensors = decode_npz(bytes, "input", limits);
    const Tensors again = decode_npz(text(encode_npz(tensors)), "again");
    if (again.size() != tensors.size()) std::abort();
    for (const auto& [name, tensor] : tensors)
      if (!same(again.at(name), tensor)) std::abort();
  } catch (const Error&) {}
  return 0;
}
