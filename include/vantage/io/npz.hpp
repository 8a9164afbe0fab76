// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/npy.hpp>
#include <vantage/io/tensor.hpp>
#include <vantage/io/zip.hpp>

namespace vantage {

/// Decodes what numpy.savez or numpy.savez_compressed wrote; `where` names it in errors. Throws Error if the archive or
/// one of its arrays is truncated, damaged or too large, or holds no plain numbers.
inline Tensors decode_npz(std::string_view bytes, const std::string& where, const TensorLimits& limits = {}) {
  const auto files = decode_zip(bytes, where, {.unpacked_bytes = limits.bytes, .entries = limits.tensors});
  Tensors tensors;
  for (const auto& [name, content] : files) {
    const std::string key = name.ends_with(".npy") ? name.substr(0, name.size() - 4) : name;
    const std::string in = concat(where, ", '", printable(name), "'");
    if (!tensors.emplace(key, decode_npy(content, in, limits)).second)
      throw Error(in, "two arrays of this name", "one");
  }
  return tensors;
}
inline Tensors read_npz(const std::filesystem::path& path, const TensorLimits& limits = {}) {
  return decode_npz(read_file(path, limits.bytes), path.string(), limits);
}

/// Tensors as numpy.savez stores them; the same tensors give the same bytes.
inline std::vector<std::byte> encode_npz(const Tensors& tensors) {
  std::map<std::string, std::string> files;
  for (const auto& [name, tensor] : tensors) {
    const std::vector<std::byte> npy = encode_npy(tensor);
    files.emplace(name + ".npy", std::string(reinterpret_cast<const char*>(npy.data()), npy.size()));
  }
  return encode_zip(files);
}
/// Writes a .npz file, whole or not at all.
inline void write_npz(const std::filesystem::path& path, const Tensors& tensors) {
  write_file(path, encode_npz(tensors));
}

}  // namespace vantage
