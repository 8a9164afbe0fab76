// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/occupancy_octree.hpp>
#include <vantage/io/printable.hpp>

// OctoMap's binary trees, .bt (https://octomap.github.io): a header in text, then each inner node, depth first, as two
// bits a child in two bytes, the first child lowest: 00 unknown, 01 free, 10 occupied, 11 another inner node.
namespace vantage {

/// What a .bt file may cost; whatever is larger is refused before it is allocated.
struct BtLimits {
  std::size_t bytes = std::size_t{256} << 20;  ///< of the file
  std::size_t leaves = std::size_t{1} << 25;   ///< 16 bytes each
};

namespace detail {

inline constexpr std::string_view bt_title = "# Octomap OcTree binary file";
enum BtChild : unsigned { bt_unknown, bt_free, bt_occupied, bt_inner };

class BtWriter {
 public:
  explicit BtWriter(const OccupancyOctree& tree) : next_(tree.leaves().begin()), end_(tree.leaves().end()) {
    if (next_ != end_) node(0, OccupancyOctree::levels);
    char edge[32];
    const auto edge_end = std::to_chars(edge, edge + sizeof edge, tree.voxel_m()).ptr;  // as many digits as it takes
    bytes_.insert(0, concat(bt_title, "\n# (feel free to add / change comments, but leave the first line as it is!)\n",
                            "#\nid OcTree\nsize ", nodes_, "\nres ", std::string_view(edge, edge_end), "\ndata\n"));
  }
  [[nodiscard]] std::string take() && { return std::move(bytes_); }

 private:
  /// The inner node of this height from `code` on: its two bytes, then those of its inner children.
  void node(std::uint64_t code, int height) {
    const std::size_t at = bytes_.size();
    const std::uint64_t child = std::uint64_t{1} << 3 * (height - 1);
    bytes_.append(2, '\0');
    ++nodes_;
    unsigned children = 0;
    for (unsigned i = 0; i < 8; ++i, code += child) {
      if (next_ == end_ || next_->code >= code + child) continue;
      if (next_->height + 1 < height) {
        children |= bt_inner << 2 * i;
        node(code, height - 1);
      } else {
        children |= (next_->space == Space::free ? bt_free : bt_occupied) << 2 * i;
        ++nodes_;
        ++next_;
      }
    }
    bytes_[at] = static_cast<char>(children & 0xFF);
    bytes_[at + 1] = static_cast<char>(children >> 8);
  }
  std::span<const OccupancyOctree::Leaf>::iterator next_, end_;
  std::string bytes_;
  std::size_t nodes_ = 0;
};

class BtReader {
 public:
  BtReader(std::string_view bytes, std::string where, const BtLimits& limits)
      : bytes_(bytes), where_(std::move(where)), limits_(limits) {}

  OccupancyOctree read() && {
    header();
    if (size_ > 0) {
      nodes_ = 1;
      node(0, OccupancyOctree::levels);
    }
    if (nodes_ != size_)
      throw Error(where_, concat("a tree of ", nodes_, " nodes"), concat(size_, ", as its header says"));
    if (at_ != bytes_.size()) refuse(concat(bytes_.size() - at_, " bytes after the last node"), "none");
    return {edge_m_, std::move(leaves_)};
  }

 private:
  /// Lines of a word and its value, in any order, until `data`; words that nobody knows are left to their writer.
  void header() {
    if (!line().starts_with(bt_title))
      throw Error(where_, "no OctoMap .bt file", concat("one that begins '", bt_title, "'"));
    bool has_size = false, has_edge = false;
    for (std::size_t begin = at_;; begin = at_) {
      const std::string_view text = line(), word = text.substr(0, text.find(' '));
      const std::string_view value = text.substr(std::min(word.size() + 1, text.size()));
      const auto must = [&](bool holds, std::string_view expected) {
        if (!holds) throw Error(where_, concat("'", printable(text), "' at byte ", begin), expected);
      };
      if (word == "data") break;
      if (word == "id") must(value == "OcTree", "id OcTree");
      if (word == "size") must(has_size = number(value, size_), "a number of nodes");
      if (word == "res")
        must(has_edge = number(value, edge_m_) && std::isfinite(edge_m_) && edge_m_ > 0, "an edge > 0 [m]");
    }
    if (!has_size || !has_edge) throw Error(where_, concat("no 'size' or no 'res' before byte ", at_), "both");
  }
  std::string_view line() {
    const std::size_t length = bytes_.substr(at_).find('\n');
    if (length == bytes_.npos) throw Error(where_, concat("ends at byte ", bytes_.size()), "the rest of the header");
    at_ += length + 1;
    std::string_view text = bytes_.substr(at_ - length - 1, length);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }
  template <class T>
  static bool number(std::string_view text, T& value) {
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failed == std::errc{} && end == text.data() + text.size();
  }

  /// The inner node of this height from `code` on.
  void node(std::uint64_t code, int height) {
    if (bytes_.size() - at_ < 2)
      throw Error(where_, concat("ends at byte ", bytes_.size()), concat("the node at byte ", at_));
    const std::size_t here = at_;
    const unsigned children = byte(at_) | byte(at_ + 1) << 8;
    if (children == 0) refuse("an inner node without children", "one at least");
    at_ += 2;
    const std::uint64_t child = std::uint64_t{1} << 3 * (height - 1);
    for (unsigned i = 0; i < 8; ++i, code += child) {
      const unsigned kind = children >> 2 * i & 3;
      if (kind == bt_unknown) continue;
      if (++nodes_ > size_)
        throw Error(where_, concat("node ", nodes_, " at byte ", here), concat(size_, ", as its header says"));
      if (kind == bt_inner) {
        if (height == 1) throw Error(where_, concat("a voxel that is cut further at byte ", here), "16 levels");
        node(code, height - 1);
      } else {
        if (leaves_.size() == limits_.leaves)
          throw Error(where_, concat("another leaf at byte ", here), concat("at most ", limits_.leaves));
        leaves_.push_back(
            {code, static_cast<std::uint8_t>(height - 1), kind == bt_free ? Space::free : Space::occupied});
      }
    }
  }
  [[nodiscard]] unsigned byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(where_, concat(what, " at byte ", at_), expected);
  }

  std::string_view bytes_;
  std::string where_;
  BtLimits limits_;
  std::size_t at_ = 0;
  std::uint64_t size_ = 0, nodes_ = 0;
  double edge_m_ = 0;
  std::vector<OccupancyOctree::Leaf> leaves_;
};

}  // namespace detail

/// A tree as the bytes of a .bt file. O(leaves).
inline std::string encode_bt(const OccupancyOctree& tree) { return detail::BtWriter(tree).take(); }
/// What a map knows, pruned as OctoMap prunes. Throws what OccupancyOctree::of throws.
template <VoxelOccupancy M>
std::string encode_bt(const M& map) {
  return encode_bt(OccupancyOctree::of(map));
}
/// Writes a .bt file, whole or not at all.
template <class T>
void write_bt(const std::filesystem::path& path, const T& what) {
  write_file(path, encode_bt(what));
}

/// Decodes a .bt file; `where` names it in errors. Throws Error, with the byte, if the header is none, the tree ends
/// too early, has more or fewer nodes than the header says or more than 16 levels, or is too large. O(bytes).
inline OccupancyOctree decode_bt(std::string_view bytes, const std::string& where, const BtLimits& limits = {}) {
  return detail::BtReader(bytes, where, limits).read();
}
inline OccupancyOctree read_bt(const std::filesystem::path& path, const BtLimits& limits = {}) {
  return decode_bt(read_file(path, limits.bytes), path.string(), limits);
}

}  // namespace vantage
