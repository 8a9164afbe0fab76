// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/pnm.hpp>
#include <vantage/io/stb.hpp>

// PNG, JPEG, PGM and PPM. stb_image decodes what two short walks over the file have found whole: it takes a truncated
// JPEG for a grey one and does not look at checksums.
namespace vantage {

namespace detail {

/// What a picture's header promises.
struct PictureHeader {
  std::size_t width = 0, height = 0;
  bool deep = false;  ///< 16 bits a value
};

/// Big-endian numbers of a file whose end is an Error.
class BigEndian {
 public:
  BigEndian(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(&where) {}
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }
  std::uint32_t number(std::size_t size) {
    std::uint32_t value = 0;
    for (const char c : take(size)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }
  std::string_view take(std::size_t size) {
    if (size > left())
      throw Error(*where_, concat("ends at byte ", bytes_.size()), concat(size, " more bytes at byte ", at_));
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(*where_, concat(what, " at byte ", at_), expected);
  }

 private:
  std::string_view bytes_;
  const std::string* where_;
  std::size_t at_ = 0;
};

constexpr std::string_view png_signature("\x89PNG\r\n\x1A\n", 8);

/// Every chunk up to the last, and its checksum (PNG, 2nd edition, 5.3).
inline PictureHeader check_png(std::string_view bytes, const std::string& where, const PictureLimits& limits) {
  PictureHeader header;
  BigEndian file(bytes, where);
  file.take(png_signature.size());
  for (bool first = true;; first = false) {
    const std::uint32_t size = file.number(4);
    if (size > file.left()) file.take(std::size_t{size} + 8);  // its end is missing
    const std::string_view chunk = file.take(std::size_t{size} + 4), type = chunk.substr(0, 4);
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
    if (file.number(4) != sum) file.refuse("a damaged chunk ends", "bytes that agree with their checksum");
    if (first != (type == "IHDR")) file.refuse("a chunk out of order ends", "IHDR first, and once");
    if (first) {
      if (size != 13) file.refuse(concat("a header of ", size, " bytes ends"), "13");
      BigEndian fields(chunk.substr(4), where);
      header.width = fields.number(4);
      header.height = fields.number(4);
      header.deep = fields.number(1) == 16;
      check_picture_size(header.width, header.height, where, limits);
    }
    if (type == "IEND") return header;
  }
}

/// Huffman tables of a segment (ITU-T T.81, B.2.4.2): the decoder must be able to build each of them. It marks a code
/// as long by the index 255, which no symbol may have.
inline void check_huffman_tables(std::string_view segment, const std::string& where, const BigEndian& file) {
  BigEndian tables(segment, where);
  while (tables.left() > 0) {
    if (tables.left() < 17) file.refuse("half a Huffman table ends", "17 bytes and its symbols");
    tables.number(1);
    std::size_t symbols = 0, codes = 0;  // codes of a length that are taken, at its scale
    for (int length = 1; length <= 16; ++length) {
      const std::size_t n = tables.number(1);
      symbols += n;
      codes = 2 * codes + n;
      if (codes > std::size_t{1} << length || symbols > 255)
        file.refuse("a Huffman table ends that has too many codes", "a prefix code of at most 255 symbols");
    }
    if (symbols > tables.left()) file.refuse("half a Huffman table ends", "all of its symbols");
    tables.take(symbols);
  }
}

/// Every segment and scan up to the end of the image (ITU-T T.81, B.1 and B.2).
inline PictureHeader check_jpeg(std::string_view bytes, const std::string& where, const PictureLimits& limits) {
  constexpr int most_scans = 128;
  PictureHeader header;
  BigEndian file(bytes, where);
  file.take(2);
  for (int scans = 0;;) {
    while (file.number(1) != 0xFF) {  // of a scan: data; between segments: nothing that counts
    }
    std::uint32_t marker = 0xFF;
    while (marker == 0xFF) marker = file.number(1);
    if (marker == 0xD9) break;
    if (marker == 0 || marker == 1 || (marker >= 0xD0 && marker <= 0xD8)) continue;  // no segment: a byte FF, restarts
    const std::uint32_t size = file.number(2);
    if (size < 2) file.refuse("a segment of less than its own size", "2 bytes or more");
    const std::string_view segment = file.take(size - 2);
    if (marker == 0xC4) check_huffman_tables(segment, where, file);
    if (marker == 0xDA && ++scans > most_scans) file.refuse("a scan too many", concat("at most ", most_scans));
    if (marker >= 0xC0 && marker <= 0xC2) {  // baseline, extended, progressive: those that can be decoded
      if (header.width != 0) file.refuse("a second frame", "one");
      BigEndian fields(segment, where);
      fields.number(1);
      header.height = fields.number(2);
      header.width = fields.number(2);
      check_picture_size(header.width, header.height, where, limits);
    }
  }
  if (header.width == 0) throw Error(where, "a JPEG without a frame that can be decoded", "baseline or progressive");
  return header;
}

template <class T, class Load>
RawPicture decode_with_stb(std::string_view bytes, const std::string& where, const PictureHeader& header, Load&& load) {
  if (bytes.size() > std::size_t{1} << 30) throw Error(where, concat(bytes.size(), " bytes"), "at most 2^30");
  stb_most_bytes = 16 * (header.width + 64) * (header.height + 64) + 2 * bytes.size() + (std::size_t{1} << 16);
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, in_file = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &in_file))
    throw Error(where, "a header that cannot be decoded", "PNG or JPEG");
  const int channels = in_file >= 3 ? 3 : 1;  // without the alpha channel
  const std::unique_ptr<T, decltype(&std::free)> values(load(data, size, &width, &height, &in_file, channels),
                                                        &std::free);
  if (!values || static_cast<std::size_t>(width) != header.width || static_cast<std::size_t>(height) != header.height)
    throw Error(where, "data that cannot be decoded", concat(header.width, " x ", header.height, " px of PNG or JPEG"));
  RawPicture picture{width, height, channels, sizeof(T) == 2 ? 65535U : 255U, {}};
  const std::size_t n = header.width * header.height * static_cast<std::size_t>(channels);
  picture.values.assign(values.get(), values.get() + n);
  return picture;
}

}  // namespace detail

/// Decodes a PNG (8 or 16 bit; transparency is dropped), JPEG, PGM or PPM picture, told apart by their first bytes;
/// `where` names it in errors. Throws Error if it is truncated (with the byte where it ends), damaged or too large.
inline RawPicture decode_raw_picture(std::string_view bytes, const std::string& where,
                                     const PictureLimits& limits = {}) {
  using namespace detail;
  if (bytes.starts_with(png_signature)) {
    const PictureHeader header = check_png(bytes, where, limits);
    if (header.deep) return decode_with_stb<stbi_us>(bytes, where, header, stbi_load_16_from_memory);
    return decode_with_stb<stbi_uc>(bytes, where, header, stbi_load_from_memory);
  }
  if (bytes.starts_with("\xFF\xD8"))
    return decode_with_stb<stbi_uc>(bytes, where, check_jpeg(bytes, where, limits), stbi_load_from_memory);
  if (PnmReader::recognises(bytes)) return PnmReader(bytes, where, limits).read();
  throw Error(where, bytes.empty() ? "an empty file" : "no picture that is known", "PNG, JPEG, PGM or PPM");
}

/// How many pixels a PNG or JPEG would be decoded to, by its header; 0 of other files, which are no smaller than what
/// they hold. Throws Error as decoding does.
inline std::size_t coded_pixels(std::string_view bytes, const std::string& where, const PictureLimits& limits = {}) {
  detail::PictureHeader header;
  if (bytes.starts_with(detail::png_signature))
    header = detail::check_png(bytes, where, limits);
  else if (bytes.starts_with("\xFF\xD8"))
    header = detail::check_jpeg(bytes, where, limits);
  return header.width * header.height;
}

/// A picture in colour, 8 bits a value; a grey one becomes one of three equal values.
inline Picture decode_picture(std::string_view bytes, const std::string& where, const PictureLimits& limits = {}) {
  const RawPicture raw = decode_raw_picture(bytes, where, limits);
  Picture picture(raw.width, raw.height);
  const std::size_t step = raw.channels == 3 ? 1 : 0;
  const std::uint16_t* from = raw.values.data();
  std::uint8_t* to = picture.data();
  const std::size_t n = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  for (std::size_t pixel = 0; pixel < n; ++pixel, from += raw.channels)
    for (std::size_t c = 0; c < 3; ++c)
      *to++ = static_cast<std::uint8_t>((255 * from[c * step] + raw.maximum / 2) / raw.maximum);
  return picture;
}

/// The values of a grey picture as they are stored, of 8 or 16 bits: depth in steps of some unit, labels. Throws Error
/// if it has colours.
inline Image<std::uint16_t> decode_grey_16(std::string_view bytes, const std::string& where,
                                           const PictureLimits& limits = {}) {
  const RawPicture raw = decode_raw_picture(bytes, where, limits);
  if (raw.channels != 1) throw Error(where, "a picture in colour", "one value a pixel");
  return Eigen::Map<const Image<std::uint16_t>>(raw.values.data(), raw.height, raw.width);
}

inline Picture read_picture(const std::filesystem::path& path, const PictureLimits& limits = {}) {
  return decode_picture(read_file(path, limits.bytes), path.string(), limits);
}
inline Image<std::uint16_t> read_grey_16(const std::filesystem::path& path, const PictureLimits& limits = {}) {
  return decode_grey_16(read_file(path, limits.bytes), path.string(), limits);
}

}  // namespace vantage
