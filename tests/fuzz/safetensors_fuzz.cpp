// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a safetensors file: refused with an Error, or read so that what is written again is read as the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/safetensors.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  Safetensors file;
  try {
    file = decode_safetensors(bytes, "input", {.bytes = 1 << 20, .axes = 8, .tensors = 64});
  } catch (const Error&) { return 0; }
  const std::vector<std::byte> written = encode_safetensors(file);
  const Safetensors again =
      decode_safetensors({reinterpret_cast<const char*>(written.data()), written.size()}, "again");
  if (again.metadata != file.metadata || encode_safetensors(again) != written) std::abort();
  return 0;
}
