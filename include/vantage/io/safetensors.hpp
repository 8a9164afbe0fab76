// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/tensor.hpp>

// https://huggingface.co/docs/safetensors: 8 bytes of the header's size, a JSON header, then the tensors without holes.
namespace vantage {

/// What a safetensors file holds.
struct Safetensors {
  Tensors tensors;
  std::map<std::string, std::string> metadata;  ///< free text by key
};

/// Decodes a safetensors file; `where` names it in errors. Throws Error if it is truncated (with the byte where it
/// ends), if a tensor's place does not fit its shape, or if tensors overlap or leave holes. O(bytes).
inline Safetensors decode_safetensors(std::string_view bytes, const std::string& where,
                                      const TensorLimits& limits = {}) {
  constexpr std::size_t size_bytes = sizeof(std::uint64_t), most_header = std::size_t{100} << 20;
  std::uint64_t header_size = 0;
  if (bytes.size() < size_bytes)
    throw Error(where, concat("ends at byte ", bytes.size()), "8 bytes of a header's size");
  std::memcpy(&header_size, bytes.data(), size_bytes);
  if (header_size > most_header) throw Error(where, concat("a header of ", header_size, " bytes"), "at most 100 MB");
  if (header_size > bytes.size() - size_bytes)
    throw Error(where, concat("ends at byte ", bytes.size()), concat("a header of ", header_size, " bytes at byte 8"));
  const std::string in = where + ", header";
  const nlohmann::json json = parse_json(bytes.substr(size_bytes, static_cast<std::size_t>(header_size)), in,
                                         {.bytes = most_header, .depth = 4});
  const std::string_view data = bytes.substr(size_bytes + static_cast<std::size_t>(header_size));

  Safetensors file;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  JsonItem(json, in).each_member([&](const std::string& name, const JsonItem& item) {
    if (name == "__metadata__")
      return item.each_member(
          [&](const std::string& key, const JsonItem& value) { file.metadata[key] = value.text(); });
    if (places.size() == limits.tensors) item.refuse("another tensor", concat("at most ", limits.tensors));
    const JsonItem dtype = item.at("dtype"), shape = item.at("shape"), offsets = item.at("data_offsets");
    const auto type = std::find_if(element_types.begin(), element_types.end(),
                                   [&](const ElementTypeInfo& t) { return t.name == dtype.text(); });
    if (type == element_types.end())
      dtype.refuse(concat("type '", printable(dtype.text()), "'"), "BOOL, I8 to I64, U8 to U64, F16, BF16, F32 or F64");
    Tensor tensor{static_cast<ElementType>(type - element_types.begin()), {}, {}};
    if (shape.size() > limits.axes) shape.refuse(concat(shape.size(), " axes"), concat("at most ", limits.axes));
    shape.each([&](const JsonItem& n) { tensor.shape.push_back(n.count(std::size_t{1} << 48)); });
    if (offsets.size() != 2) offsets.refuse(concat(offsets.size(), " offsets"), "begin and end");
    const std::size_t end = offsets.at(1).count(std::size_t{1} << 48);
    const std::size_t begin = offsets.at(std::size_t{0}).count(end);
    if (end > data.size())
      throw Error(where, concat("ends at byte ", bytes.size()),
                  concat("'", printable(name), "' up to byte ", size_bytes + header_size + end));
    const std::size_t size = detail::tensor_bytes(tensor.shape, tensor.type, limits.bytes, in + ": " + printable(name));
    if (size != end - begin) offsets.refuse(concat(end - begin, " bytes"), concat(size, ", by type and shape"));
    tensor.bytes.resize(size);
    if (size != 0) std::memcpy(tensor.bytes.data(), data.data() + begin, size);
    places.emplace_back(begin, end);
    file.tensors.emplace(name, std::move(tensor));
  });
  std::sort(places.begin(), places.end());
  std::size_t at = 0;
  for (const auto& [begin, end] : places) {
    if (begin != at)
      throw Error(where, concat("tensors overlap or leave a hole at byte ", size_bytes + header_size + at),
                  "one after the other");
    at = end;
  }
  if (at != data.size()) throw Error(where, concat(data.size() - at, " bytes after the last tensor"), "none");
  return file;
}
inline Safetensors read_safetensors(const std::filesystem::path& path, const TensorLimits& limits = {}) {
  return decode_safetensors(read_file(path, limits.bytes), path.string(), limits);
}

/// The bytes of a safetensors file, tensors in the order of their names; the same contents give the same bytes. Throws
/// Error if a name is no UTF-8.
inline std::vector<std::byte> encode_safetensors(const Safetensors& file) {
  nlohmann::json header = nlohmann::json::object();
  if (!file.metadata.empty()) header["__metadata__"] = file.metadata;
  std::size_t at = 0;
  for (const auto& [name, tensor] : file.tensors) {
    header[name] = {
        {"dtype", info(tensor.type).name}, {"shape", tensor.shape}, {"data_offsets", {at, at + tensor.bytes.size()}}};
    at += tensor.bytes.size();
  }
  std::string text;
  try {
    text = header.dump();
  } catch (const nlohmann::json::exception&) {
    throw Error("encode_safetensors", "a name or metadata that is no text", "UTF-8");
  }
  text.append((8 - text.size() % 8) % 8, ' ');  // tensors begin on a multiple of 8 bytes
  const std::uint64_t size = text.size();
  std::vector<std::byte> bytes(sizeof size + text.size());
  std::memcpy(bytes.data(), &size, sizeof size);
  std::memcpy(bytes.data() + sizeof size, text.data(), text.size());
  for (const auto& [name, tensor] : file.tensors) bytes.insert(bytes.end(), tensor.bytes.begin(), tensor.bytes.end());
  return bytes;
}
/// Writes a safetensors file, whole or not at all.
inline void write_safetensors(const std::filesystem::path& path, const Safetensors& file) {
  write_file(path, encode_safetensors(file));
}

}  // namespace vantage
