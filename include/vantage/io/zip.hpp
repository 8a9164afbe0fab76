// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/printable.hpp>

// Archives as npz needs them: entries stored or deflated, below 4 GB (PKWARE's APPNOTE.TXT 6.3.10).
namespace vantage {

/// What an archive may cost; whatever is larger is refused before it is allocated.
struct ZipLimits {
  std::size_t unpacked_bytes = std::size_t{2} << 30;  ///< of all entries
  std::size_t entries = std::size_t{1} << 16;
};

/// Reads a ZIP archive by its directory, and every entry's size and checksum with it.
class ZipReader {
 public:
  ZipReader(std::string_view bytes, std::string where, const ZipLimits& limits)
      : bytes_(bytes), where_(std::move(where)), limits_(limits) {}

  /// Contents by name.
  std::map<std::string, std::string> read() && {
    const std::size_t end = find_end();
    const std::uint64_t entries = number(end + 10, 2), directory = number(end + 16, 4);
    if (entries > limits_.entries)
      throw Error(where_, concat(entries, " entries"), concat("at most ", limits_.entries));
    std::map<std::string, std::string> contents;
    std::size_t at = static_cast<std::size_t>(directory), unpacked = 0;
    for (std::uint64_t i = 0; i < entries; ++i) {
      if (number(at, 4) != 0x02014B50) refuse(at, "no entry of a directory", "PK\\1\\2");
      const Entry entry{.at = at,
                        .flags = number(at + 8, 2),
                        .method = number(at + 10, 2),
                        .sum = number(at + 16, 4),
                        .packed = number(at + 20, 4),
                        .size = number(at + 24, 4),
                        .local = number(at + 42, 4)};
      const std::uint64_t name_size = number(at + 28, 2);
      const std::string name(part(at + 46, name_size));
      if (entry.size == 0xFFFFFFFF || entry.packed == 0xFFFFFFFF || entry.local == 0xFFFFFFFF)
        refuse(at, concat("'", printable(name), "' of 4 GB or more (ZIP64)"), "smaller entries");
      unpacked += entry.size;
      if (unpacked > limits_.unpacked_bytes)
        refuse(at, concat(unpacked, " bytes when unpacked"), concat("at most ", limits_.unpacked_bytes));
      if (!contents.emplace(name, unpack(entry)).second) refuse(at, concat("two of '", printable(name), "'"), "one");
      at += 46 + name_size + number(at + 30, 2) + number(at + 32, 2);
    }
    return contents;
  }

 private:
  struct Entry {
    std::size_t at;
    std::uint64_t flags, method, sum, packed, size, local;
  };

  std::string unpack(const Entry& entry) const {
    const auto local = static_cast<std::size_t>(entry.local);
    if (number(local, 4) != 0x04034B50) refuse(local, "no local header of an entry", "PK\\3\\4");
    if (entry.flags & 1) refuse(entry.at, "an encrypted entry", "an open one");
    const std::string_view packed = part(local + 30 + number(local + 26, 2) + number(local + 28, 2), entry.packed);
    std::string content;
    if (entry.method == 0) {
      if (entry.packed != entry.size) refuse(entry.at, "a stored entry of two sizes", "one size");
      content = packed;
    } else if (entry.method == 8) {
      if (entry.size / 1032 > entry.packed + 1)  // deflate cannot do better
        refuse(entry.at, concat(entry.size, " bytes from ", entry.packed), "at most 1032 times as many");
      content = inflate_whole(packed, entry);
    } else {
      refuse(entry.at, concat("compression method ", entry.method), "0 (stored) or 8 (deflated)");
    }
    if (crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())) != entry.sum)
      refuse(local, "a damaged entry", "bytes that agree with their checksum");
    return content;
  }

  std::string inflate_whole(std::string_view packed, const Entry& entry) const {
    std::string content(static_cast<std::size_t>(entry.size), '\0');
    z_stream stream = {};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    stream.avail_out = static_cast<uInt>(content.size());
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw Error(where_, "no memory to inflate");
    const int result = inflate(&stream, Z_FINISH);
    const bool whole = result == Z_STREAM_END && stream.total_out == entry.size;
    inflateEnd(&stream);
    if (!whole) refuse(entry.at, "data that cannot be inflated to their size", concat(entry.size, " bytes"));
    return content;
  }

  /// The record that ends the archive; a comment of up to 65535 bytes may follow it.
  [[nodiscard]] std::size_t find_end() const {
    constexpr std::size_t record = 22;
    const std::size_t earliest = bytes_.size() - std::min(bytes_.size(), record + 65535);
    const std::size_t at = bytes_.rfind("PK\5\6");
    if (at == bytes_.npos || at < earliest || at + record > bytes_.size())
      throw Error(where_, concat("ends at byte ", bytes_.size()), "the end record of a ZIP archive");
    return at;
  }
  /// A little-endian number.
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t size) const {
    std::uint64_t value = 0;
    const std::string_view digits = part(at, size);
    for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(digits[i]);
    return value;
  }
  [[nodiscard]] std::string_view part(std::uint64_t at, std::uint64_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at)
      throw Error(where_, concat("ends at byte ", bytes_.size()), concat(size, " bytes at byte ", at));
    return bytes_.substr(static_cast<std::size_t>(at), static_cast<std::size_t>(size));
  }
  [[noreturn]] void refuse(std::size_t at, std::string_view what, std::string_view expected) const {
    throw Error(where_, concat(what, " at byte ", at), expected);
  }

  std::string_view bytes_;
  std::string where_;
  ZipLimits limits_;
};

/// Contents of an archive by name; `where` names it in errors.
inline std::map<std::string, std::string> decode_zip(std::string_view bytes, const std::string& where,
                                                     const ZipLimits& limits = {}) {
  return ZipReader(bytes, where, limits).read();
}

/// An archive of stored entries; the same contents give the same bytes. Throws Error if one is of 4 GB or more.
inline std::vector<std::byte> encode_zip(const std::map<std::string, std::string>& contents) {
  std::string out, directory;
  const auto put = [](std::string& to, std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) to.push_back(static_cast<char>(value >> (8 * i)));
  };
  for (const auto& [name, content] : contents) {
    if (out.size() + content.size() + name.size() > 0xFFFF0000 || name.size() > 0xFFFF || contents.size() > 0xFFFE)
      throw Error("encode_zip", concat("an archive of 4 GB or more at '", printable(name), "'"), "a smaller one");
    const auto local = out.size();
    std::string common;          // what both headers say
    put(common, 20, 2);          // version 2.0
    put(common, 1 << 11, 2);     // names in UTF-8
    put(common, 0, 2);           // stored
    put(common, 0x00210000, 4);  // 1 January 1980
    put(common, crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())), 4);
    put(common, content.size(), 4);
    put(common, content.size(), 4);
    put(common, name.size(), 2);
    put(common, 0, 2);
    out.append("PK\3\4").append(common).append(name).append(content);
    directory.append("PK\1\2");
    put(directory, 20, 2);
    directory.append(common);
    for (const int size : {2, 2, 2, 4}) put(directory, 0, size);  // comment, disk, attributes
    put(directory, local, 4);
    directory.append(name);
  }
  const std::size_t start = out.size();
  out += directory;
  out.append("PK\5\6");
  put(out, 0, 4);
  put(out, contents.size(), 2);
  put(out, contents.size(), 2);
  put(out, directory.size(), 4);
  put(out, start, 4);
  put(out, 0, 2);
  const auto* begin = reinterpret_cast<const std::byte*>(out.data());
  return {begin, begin + out.size()};
}

}  // namespace vantage
