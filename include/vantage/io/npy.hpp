// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/printable.hpp>
#include <vantage/io/tensor.hpp>

namespace vantage {

/// A tensor as the bytes of a .npy file (numpy's format 1.0, C order). Throws Error if numpy has no such type.
inline std::vector<std::byte> encode_npy(const Tensor& tensor) {
  constexpr std::string_view magic = "\x93NUMPY\x01";  // and a version's second byte, 0
  const ElementTypeInfo& type = info(tensor.type);
  if (type.npy.empty()) throw Error("encode_npy", concat("values of type ", type.name), "a type that numpy has");
  std::string shape;
  for (const std::size_t n : tensor.shape) shape += concat(n, ", ");
  if (tensor.shape.size() > 1) shape.resize(shape.size() - 2);  // a tuple of one keeps its comma
  if (tensor.shape.size() == 1) shape.pop_back();
  std::string header = concat("{'descr': '", type.bytes == 1 ? '|' : '<', type.npy,
                              "', 'fortran_order': False, 'shape': (", shape, "), }");
  const std::size_t before = magic.size() + 3;  // the 0 and a 16-bit length
  header.append(63 - (before + header.size()) % 64, ' ').append("\n");
  std::vector<std::byte> bytes(before + header.size() + tensor.bytes.size());
  std::memcpy(bytes.data(), magic.data(), magic.size());
  const auto length = static_cast<std::uint16_t>(header.size());
  std::memcpy(bytes.data() + magic.size() + 1, &length, sizeof length);
  std::memcpy(bytes.data() + before, header.data(), header.size());
  if (!tensor.bytes.empty())
    std::memcpy(bytes.data() + before + header.size(), tensor.bytes.data(), tensor.bytes.size());
  return bytes;
}
/// A raster of shape (rows, columns).
template <class T>
std::vector<std::byte> encode_npy(const Image<T>& values) {
  return encode_npy(Tensor::of(values));
}

/// Writes a .npy file, whole or not at all: numpy.load(path) gives the values.
template <class T>
void write_npy(const std::filesystem::path& path, const T& values) {
  write_file(path, encode_npy(values));
}

/// Reads numpy's .npy files (formats 1.0 to 3.0;
/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
class NpyReader {
 public:
  NpyReader(std::string_view bytes, std::string where, const TensorLimits& limits)
      : bytes_(bytes), where_(std::move(where)), limits_(limits) {}

  Tensor read() && {
    const std::string_view magic = "\x93NUMPY";
    if (!bytes_.starts_with(magic)) throw Error(where_, "no npy file", "one that begins with \\x93NUMPY");
    at_ = magic.size();
    const unsigned major = byte();
    byte();
    if (major < 1 || major > 3) refuse(concat("version ", major, " of the format"), "1 to 3");
    std::size_t length = 0;
    for (unsigned i = 0, n = major == 1 ? 2 : 4; i < n; ++i) length |= std::size_t{byte()} << (8 * i);
    if (length > 65536) refuse(concat("a header of ", length, " bytes"), "at most 65536");
    if (length > bytes_.size() - at_) end();
    header_end_ = at_ + length;
    header();
    at_ = header_end_;
    const std::size_t left = bytes_.size() - at_;
    const std::size_t size = detail::tensor_bytes(tensor_.shape, tensor_.type, limits_.bytes, where_);
    if (size > left) throw Error(where_, concat("ends at byte ", bytes_.size()), concat(size - left, " bytes more"));
    if (size < left) refuse(concat(left - size, " bytes after the last value"), "none");
    tensor_.bytes.resize(size);
    if (size != 0) copy_values();
    return std::move(tensor_);
  }

 private:
  unsigned byte() {
    if (at_ >= bytes_.size()) end();
    return static_cast<unsigned char>(bytes_[at_++]);
  }

  /// A Python dictionary of 'descr', 'fortran_order' and 'shape', each once.
  void header() {
    bool type = false, order = false, shape = false;
    expect('{');
    while (!next_is('}')) {
      const std::string_view key = quoted();
      expect(':');
      if (key == "descr" && !std::exchange(type, true))
        descr(quoted());
      else if (key == "fortran_order" && !std::exchange(order, true))
        fortran_ = truth();
      else if (key == "shape" && !std::exchange(shape, true))
        read_shape();
      else
        refuse(concat("key '", printable(key), "'"), "descr, fortran_order and shape, each once");
      if (!next_is(',')) {
        expect('}');
        break;
      }
    }
    if (!type || !order || !shape) refuse("a header that lacks a key", "descr, fortran_order and shape");
  }
  void descr(std::string_view text) {
    const auto known = std::find_if(element_types.begin(), element_types.end(), [&](const ElementTypeInfo& t) {
      return !t.npy.empty() && text.size() > 1 && t.npy == text.substr(1);
    });
    if (known == element_types.end() || (text[0] != '<' && text[0] != '|' && text[0] != '>'))
      refuse(concat("values of type '", printable(text), "'"),
             "numbers of a fixed size: b1, i1 to i8, u1 to u8, f2 to f8");
    tensor_.type = static_cast<ElementType>(known - element_types.begin());
    big_endian_ = text[0] == '>';
  }
  void read_shape() {
    expect('(');
    while (!next_is(')')) {
      if (tensor_.shape.size() == limits_.axes) refuse("another axis", concat("at most ", limits_.axes));
      tensor_.shape.push_back(number());
      if (!next_is(',')) {
        expect(')');
        break;
      }
    }
  }

  void blanks() {
    while (at_ < header_end_ && (bytes_[at_] == ' ' || bytes_[at_] == '\n')) ++at_;
  }
  bool next_is(char c) {
    blanks();
    if (at_ >= header_end_ || bytes_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!next_is(c)) refuse("a header that is no Python dictionary of numpy's", concat("'", c, "'"));
  }
  std::string_view quoted() {
    expect('\'');
    const std::size_t length = bytes_.substr(at_, header_end_ - at_).find('\'');
    if (length == bytes_.npos) refuse("a quote is not closed", "a closing quote");
    at_ += length + 1;
    return bytes_.substr(at_ - length - 1, length);
  }
  bool truth() {
    blanks();
    const std::string_view rest = bytes_.substr(at_, header_end_ - at_);
    const bool value = rest.starts_with("True");
    if (!value && !rest.starts_with("False")) refuse(concat("'", printable(rest, 8), "'"), "True or False");
    at_ += value ? 4 : 5;
    return value;
  }
  std::size_t number() {
    blanks();
    std::size_t value = 0;
    const auto [end, failed] = std::from_chars(bytes_.data() + at_, bytes_.data() + header_end_, value);
    if (failed != std::errc{}) refuse(concat("'", printable(bytes_.substr(at_), 8), "'"), "a size");
    at_ = static_cast<std::size_t>(end - bytes_.data());
    return value;
  }

  /// Into C order, little-endian.
  void copy_values() {
    const std::size_t size = info(tensor_.type).bytes, n = tensor_.bytes.size() / size;
    const auto* from = reinterpret_cast<const std::byte*>(bytes_.data()) + at_;
    std::vector<std::size_t> index(tensor_.shape.size(), 0);
    for (std::size_t i = 0; i < n; ++i) {  // in the file's order; `index` is where the value belongs
      std::size_t to = i;
      if (fortran_) {
        to = 0;
        for (std::size_t axis = 0; axis < index.size(); ++axis) to = to * tensor_.shape[axis] + index[axis];
        for (std::size_t axis = 0; axis < index.size() && ++index[axis] == tensor_.shape[axis]; ++axis) index[axis] = 0;
      }
      std::byte* value = tensor_.bytes.data() + to * size;
      std::memcpy(value, from + i * size, size);
      if (big_endian_) std::reverse(value, value + size);
    }
  }

  [[noreturn]] void end() const {
    throw Error(where_, concat("ends at byte ", bytes_.size()), "the rest of the npy header");
  }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(where_, concat(what, " at byte ", at_), expected);
  }

  std::string_view bytes_;
  std::string where_;
  TensorLimits limits_;
  std::size_t at_ = 0, header_end_ = 0;
  bool fortran_ = false, big_endian_ = false;
  Tensor tensor_;
};

/// Decodes a .npy file; `where` names it in errors. Throws Error if it is truncated (with the byte where it ends),
/// holds no plain numbers or is too large. O(bytes).
inline Tensor decode_npy(std::string_view bytes, const std::string& where, const TensorLimits& limits = {}) {
  return NpyReader(bytes, where, limits).read();
}
inline Tensor read_npy(const std::filesystem::path& path, const TensorLimits& limits = {}) {
  return decode_npy(read_file(path, limits.bytes), path.string(), limits);
}

}  // namespace vantage
