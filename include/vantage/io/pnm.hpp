// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// A picture as it lies in a file: `channels` values a pixel (1 grey, 3 red, green, blue), none above `maximum`.
struct RawPicture {
  int width = 0, height = 0, channels = 0;
  std::uint32_t maximum = 255;        ///< what is white: 255, 65535, or what a PGM file says
  std::vector<std::uint16_t> values;  ///< row by row, the top row first
};

/// What a picture may cost; whatever is larger is refused before it is allocated.
struct PictureLimits {
  std::size_t bytes = std::size_t{256} << 20;  ///< of the file
  std::size_t pixels = std::size_t{1} << 26;   ///< width x height (and each at most 32768)
};

namespace detail {

inline void check_picture_size(std::size_t width, std::size_t height, const std::string& where,
                               const PictureLimits& limits) {
  if (width < 1 || height < 1 || width > 32768 || height > 32768 || width * height > limits.pixels)
    throw Error(where, concat("a picture of ", width, " x ", height, " px"),
                concat("1 to 32768 px a side, at most ", limits.pixels, " in all"));
}

}  // namespace detail

/// Reads the portable grey and colour maps of Netpbm: PGM and PPM, as text (P2, P3) or binary (P5, P6), 8 or 16 bit.
class PnmReader {
 public:
  PnmReader(std::string_view bytes, std::string where, const PictureLimits& limits)
      : bytes_(bytes), where_(std::move(where)), limits_(limits) {}

  static bool recognises(std::string_view bytes) {
    return bytes.size() > 2 && bytes[0] == 'P' &&
           (bytes[1] == '2' || bytes[1] == '3' || bytes[1] == '5' || bytes[1] == '6');
  }

  RawPicture read() && {
    if (!recognises(bytes_)) throw Error(where_, "no PGM or PPM", "a file that begins with P2, P3, P5 or P6");
    const char kind = bytes_[1];
    at_ = 2;
    RawPicture picture;
    picture.channels = kind == '3' || kind == '6' ? 3 : 1;
    const std::size_t width = number(1 << 20, "a width"), height = number(1 << 20, "a height");
    picture.maximum = static_cast<std::uint32_t>(number(65535, "the largest value, 1 to 65535"));
    if (picture.maximum == 0) refuse("the largest value is 0", "1 to 65535");
    detail::check_picture_size(width, height, where_, limits_);
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    const std::size_t n = width * height * static_cast<std::size_t>(picture.channels);
    const bool text = kind < '4';
    const std::size_t value_bytes = text || picture.maximum > 255 ? 2 : 1;  // of a text: a digit and a blank
    if (!text) ++at_;                                                       // exactly one blank ends the header
    const std::size_t left = at_ < bytes_.size() ? bytes_.size() - at_ : 0;
    if (n * value_bytes > left + (text ? 1 : 0))
      throw Error(where_, concat("ends at byte ", bytes_.size()),
                  concat(n, " values of ", width, " x ", height, " px, ", n * value_bytes - left, " bytes more"));
    picture.values.resize(n);
    for (std::uint16_t& value : picture.values) {
      if (text) {
        value = static_cast<std::uint16_t>(number(picture.maximum, "a value up to the largest"));
      } else {
        std::uint32_t v = byte();
        if (value_bytes == 2) v = 256 * v + byte();  // big-endian
        if (v > picture.maximum) refuse(concat("value ", v), concat("at most ", picture.maximum));
        value = static_cast<std::uint16_t>(v);
      }
    }
    return picture;
  }

 private:
  [[nodiscard]] std::uint32_t byte() { return static_cast<unsigned char>(bytes_[at_++]); }

  /// The next number of a text, after blanks and comments.
  std::size_t number(std::size_t most, std::string_view expected) {
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at_ < bytes_.size() && (blank(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#')
        at_ = std::min(bytes_.find('\n', at_), bytes_.size());
      else
        ++at_;
    }
    if (at_ >= bytes_.size()) throw Error(where_, concat("ends at byte ", bytes_.size()), expected);
    std::size_t value = 0;
    const std::size_t begin = at_;
    for (; at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
      value = 10 * value + static_cast<std::size_t>(bytes_[at_] - '0');
      if (value > most) refuse(concat("a number above ", most), expected);
    }
    if (at_ == begin) refuse(concat("'", printable(bytes_.substr(at_), 8), "'"), expected);
    return value;
  }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(where_, concat(what, " at byte ", at_), expected);
  }

  std::string_view bytes_;
  std::string where_;
  PictureLimits limits_;
  std::size_t at_ = 0;
};

}  // namespace vantage
