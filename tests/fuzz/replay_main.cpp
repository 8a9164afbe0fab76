// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Runs a fuzz target without a fuzzer: over every file of a corpus, whole and cut short.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

// A copy of just that size, so that AddressSanitizer sees a read past the end.
void replay(const std::vector<char>& bytes, std::size_t size) {
  const std::vector<std::uint8_t> input(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

}  // namespace

int main(int argc, char** argv) {
  constexpr std::size_t cuts = 256;
  std::size_t inputs = 0;
  for (int i = 1; i < argc; ++i) {
    if (!std::filesystem::is_directory(argv[i])) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
      std::cout << entry.path().string() << ": " << bytes.size() << " bytes\n" << std::flush;
      const std::size_t stride = std::max<std::size_t>(1, bytes.size() / cuts);
      for (std::size_t size = 0; size < bytes.size(); size += stride) replay(bytes, size);
      replay(bytes, bytes.size());
      ++inputs;
    }
  }
  if (inputs == 0) {
    std::cerr << "usage: " << argv[0] << " FOLDER...   (no file found: nothing was tested)\n";
    return 1;
  }
  return 0;
}
