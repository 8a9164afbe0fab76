// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/number.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// Points and what is known of each.
struct PointCloud {
  /// A number of each point that has a name of its own, such as `confidence`.
  struct Scalar {
    std::string name;
    std::vector<float> values;  ///< one a point
  };
  std::vector<Eigen::Vector3f> points;   ///< [m]
  std::vector<Eigen::Vector3f> normals;  ///< one a point, or none
  std::vector<Eigen::Vector3f> colours;  ///< one a point, RGB in [0, 1]; or none
  std::vector<Scalar> scalars;
};

/// What a PLY file may cost; whatever is larger is refused before it is allocated.
struct PlyLimits {
  std::size_t bytes = std::size_t{4} << 30;
  std::size_t header_bytes = std::size_t{1} << 16;
  std::size_t triangles = std::size_t{1} << 28;  ///< after faces of many corners have been cut
};

/// Reads PLY files (Greg Turk, "The PLY Polygon File Format", 1994): text, or binary of either byte order.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, std::string where, const PlyLimits& limits)
      : bytes_(bytes), where_(std::move(where)), limits_(limits) {}

  PlyReader& read() & {
    header();
    bool vertices = false;
    for (const Element& element : elements_) {
      check_room(element);
      if (element.name == "vertex") {
        if (std::exchange(vertices, true)) refuse("a second element 'vertex'", "one");
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for (std::size_t i = 0; i < element.rows(); ++i)
          for (const Property& p : element.properties) skip(p);
      }
    }
    if (!vertices) refuse("no element 'vertex'", "points");
    return *this;
  }
  /// The faces cut into triangles, corner 0 with each edge that does not touch it. Throws Error if there is none, if a
  /// vertex is not finite, or if a face uses one that does not exist.
  [[nodiscard]] TriangleMesh mesh() && {
    TriangleMesh mesh{std::move(cloud_.points), std::move(triangles_), std::move(cloud_.colours)};
    mesh.validate(where_);
    if (mesh.empty()) throw Error(where_, "no face", "at least one triangle");
    return mesh;
  }
  [[nodiscard]] PointCloud points() && {
    for (std::size_t i = 0; i < cloud_.points.size(); ++i)
      if (!cloud_.points[i].allFinite())
        throw Error(where_, concat("point ", i, " is (", cloud_.points[i].transpose(), ")"), "finite coordinates");
    return std::move(cloud_);
  }

 private:
  enum class Type : std::uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };
  struct Property {
    std::string name;
    Type type;
    std::optional<Type> count;  ///< of a list: what its length is stored as
  };
  struct Element {
    std::string name;
    std::size_t count;
    std::vector<Property> properties;
    [[nodiscard]] std::size_t rows() const { return properties.empty() ? 0 : count; }
  };

  static constexpr std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
  }
  [[nodiscard]] Type type_of(std::string_view name) const {
    constexpr std::array<std::string_view, 16> names = {"char",  "uchar",  "short",   "ushort", "int",   "uint",
                                                        "float", "double", "int8",    "uint8",  "int16", "uint16",
                                                        "int32", "uint32", "float32", "float64"};
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end()) refuse(concat("type '", printable(name), "'"), "char, uchar, ..., float or double");
    return static_cast<Type>((it - names.begin()) % 8);
  }

  void header() {
    if (line() != "ply") throw Error(where_, "no PLY file", "one whose first line is 'ply'");
    bool format = false;
    for (;;) {
      std::string_view rest = line();
      const std::string_view key = word(rest);
      if (key == "comment" || key == "obj_info" || key.empty()) continue;
      if (key == "end_header") break;
      if (key == "format") {
        const std::string_view kind = word(rest);
        if (kind != "ascii" && kind != "binary_little_endian" && kind != "binary_big_endian")
          refuse(concat("format '", printable(kind), "'"), "ascii, binary_little_endian or binary_big_endian");
        text_ = kind == "ascii";
        swapped_ = kind == "binary_big_endian";
        format = true;
      } else if (key == "element") {
        const std::string_view name = word(rest), digits = word(rest);
        std::size_t count = 0;
        const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
        if (failed != std::errc{} || end != digits.data() + digits.size())
          refuse(concat("'", printable(digits), "' elements"), "a whole number");
        elements_.push_back({std::string(name), count, {}});
      } else if (key == "property" && !elements_.empty()) {
        Property p{"", Type::U8, std::nullopt};
        std::string_view type = word(rest);
        if (type == "list") {
          p.count = type_of(word(rest));
          type = word(rest);
        }
        p.type = type_of(type);
        p.name = word(rest);
        elements_.back().properties.push_back(std::move(p));
      } else {
        refuse(concat("'", printable(key), "' in the header"), "format, element, property, comment or end_header");
      }
    }
    if (!format) refuse("a header without a format", "a line 'format ...'");
  }
  std::string_view line() {
    const std::size_t end = bytes_.substr(0, limits_.header_bytes).find('\n', at_);
    if (end == bytes_.npos) {
      if (bytes_.size() >= limits_.header_bytes) refuse("a header that does not end", "a line 'end_header'");
      throw Error(where_, concat("ends at byte ", bytes_.size()), "the rest of a PLY header");
    }
    std::string_view text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
  }
  static std::string_view word(std::string_view& rest) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    const std::string_view first = rest.substr(0, rest.find_first_of(" \t"));
    rest.remove_prefix(first.size());
    return first;
  }

  /// Throws unless the bytes that are left can hold so many elements: a value of a text is a digit and a blank.
  void check_room(const Element& element) const {
    std::size_t least = 0;
    for (const Property& p : element.properties) least += text_ ? 2 : size_of(p.count.value_or(p.type));
    const std::size_t left = bytes_.size() - at_ + (text_ ? 1 : 0);
    if (least != 0 && element.count > left / least)
      throw Error(where_, concat("ends at byte ", bytes_.size()),
                  concat(element.count, " of element '", printable(element.name), "' from byte ", at_));
  }

  void read_vertices(const Element& element) {
    const auto index = [&](std::initializer_list<std::string_view> names) {
      const auto& all = element.properties;
      return std::find_if(all.begin(), all.end(),
                          [&](const Property& p) {
                            return !p.count && std::find(names.begin(), names.end(), p.name) != names.end();
                          }) -
             all.begin();
    };
    const std::ptrdiff_t none = std::ssize(element.properties);
    const std::array position = {index({"x"}), index({"y"}), index({"z"})};
    const std::array normal = {index({"nx"}), index({"ny"}), index({"nz"})};
    const std::array colour = {index({"red", "diffuse_red"}), index({"green", "diffuse_green"}),
                               index({"blue", "diffuse_blue"})};
    const auto has = [&](const std::array<std::ptrdiff_t, 3>& columns) {
      return std::find(columns.begin(), columns.end(), none) == columns.end();
    };
    if (!has(position)) refuse("vertices without x, y and z", "all three");
    std::vector<std::size_t> others;
    for (std::ptrdiff_t i = 0; i < none; ++i) {
      const auto in = [&](const std::array<std::ptrdiff_t, 3>& c) {
        return has(c) && std::find(c.begin(), c.end(), i) != c.end();
      };
      const Property& p = element.properties[static_cast<std::size_t>(i)];
      if (p.count || in(position) || in(normal) || in(colour)) continue;
      others.push_back(static_cast<std::size_t>(i));
      cloud_.scalars.push_back({p.name, std::vector<float>(element.count)});
    }
    cloud_.points.resize(element.count);
    if (has(normal)) cloud_.normals.resize(element.count);
    if (has(colour)) cloud_.colours.resize(element.count);

    std::vector<double> row(element.properties.size());
    const auto triple = [&](const std::array<std::ptrdiff_t, 3>& columns) {
      Eigen::Vector3d v;
      for (int k = 0; k < 3; ++k) v[k] = row[static_cast<std::size_t>(columns[static_cast<std::size_t>(k)])];
      return v;
    };
    const double white = !has(colour) ? 1 : maximum(element.properties[static_cast<std::size_t>(colour[0])].type);
    for (std::size_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (element.properties[k].count)
          skip(element.properties[k]);
        else
          row[k] = value(element.properties[k].type);
      }
      cloud_.points[i] = triple(position).cast<float>();
      if (has(normal)) cloud_.normals[i] = triple(normal).cast<float>();
      if (has(colour)) {
        const Eigen::Vector3d c = triple(colour) / white;
        if (!(c.array() >= 0).all() || !(c.array() <= 1).all())
          refuse(concat("vertex ", i, " has colour (", c.transpose(), ")"), "in [0, 1] of its type");
        cloud_.colours[i] = c.cast<float>();
      }
      for (std::size_t k = 0; k < others.size(); ++k) cloud_.scalars[k].values[i] = static_cast<float>(row[others[k]]);
    }
  }
  /// What is white in a colour of this type.
  static double maximum(Type type) {
    if (type == Type::F32 || type == Type::F64) return 1;
    return std::ldexp(1.0, static_cast<int>(8 * size_of(type))) - 1;
  }

  void read_faces(const Element& element) {
    std::vector<std::uint32_t> corners;
    for (std::size_t i = 0; i < element.rows(); ++i)
      for (const Property& p : element.properties) {
        if (!p.count || (p.name != "vertex_indices" && p.name != "vertex_index")) {
          skip(p);
          continue;
        }
        const std::size_t n = list_size(p);
        corners.resize(n);
        for (std::uint32_t& corner : corners) {
          const double v = value(p.type);
          if (!(v >= 0 && v <= 4294967295.0 && v == std::floor(v)))
            refuse(concat("face ", i, " uses vertex ", v), "a whole number >= 0");
          corner = static_cast<std::uint32_t>(v);
        }
        if (n < 3) refuse(concat("face ", i, " has ", n, " corners"), "3 or more");
        if (triangles_.size() + n - 2 > limits_.triangles)
          refuse(concat("more than ", limits_.triangles, " triangles"), "fewer");
        for (std::size_t k = 1; k + 1 < n; ++k) triangles_.push_back({corners[0], corners[k], corners[k + 1]});
      }
  }

  std::size_t list_size(const Property& p) {
    const double n = value(*p.count);
    const std::size_t left = bytes_.size() - at_ + 1, least = text_ ? 2 : size_of(p.type);
    if (!(n >= 0 && n == std::floor(n))) refuse(concat("a list of ", n), "a whole number >= 0");
    if (n > static_cast<double>(left / least))
      throw Error(where_, concat("ends at byte ", bytes_.size()), concat("a list of ", n, " values at byte ", at_));
    return static_cast<std::size_t>(n);
  }
  void skip(const Property& p) {
    const std::size_t n = p.count ? list_size(p) : 1;
    for (std::size_t i = 0; i < n; ++i) value(p.type);
  }
  double value(Type type) {
    if (text_) return number();
    switch (type) {
      case Type::I8:
        return binary<std::int8_t>();
      case Type::U8:
        return binary<std::uint8_t>();
      case Type::I16:
        return binary<std::int16_t>();
      case Type::U16:
        return binary<std::uint16_t>();
      case Type::I32:
        return binary<std::int32_t>();
      case Type::U32:
        return binary<std::uint32_t>();
      case Type::F32:
        return static_cast<double>(binary<float>());
      case Type::F64:
        return binary<double>();
    }
    return 0;
  }
  template <class T>
  T binary() {
    if (sizeof(T) > bytes_.size() - at_)
      throw Error(where_, concat("ends at byte ", bytes_.size()), concat(sizeof(T), " more bytes at byte ", at_));
    std::array<std::byte, sizeof(T)> b;
    std::memcpy(b.data(), bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swapped_) std::reverse(b.begin(), b.end());
    return std::bit_cast<T>(b);
  }
  double number() {
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at_ < bytes_.size() && blank(bytes_[at_])) ++at_;
    if (at_ == bytes_.size()) throw Error(where_, concat("ends at byte ", at_), "another number");
    std::string_view rest = bytes_.substr(at_);
    double x = 0;
    if (!take_number(rest, x) || (!rest.empty() && !blank(rest[0])))
      refuse(concat("'", printable(bytes_.substr(at_), 12), "'"), "a number");
    at_ = bytes_.size() - rest.size();
    return x;
  }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(where_, concat(what, " at byte ", at_), expected);
  }

  std::string_view bytes_;
  std::string where_;
  PlyLimits limits_;
  std::size_t at_ = 0;
  bool text_ = false, swapped_ = false;
  std::vector<Element> elements_;
  PointCloud cloud_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// Decodes a PLY mesh with its vertex colours, if any; `where` names it in errors. Throws Error if it is truncated
/// (with the byte where it ends), has no face, or a vertex that is not finite (with its index).
inline TriangleMesh decode_ply_mesh(std::string_view bytes, const std::string& where, const PlyLimits& limits = {}) {
  PlyReader reader(bytes, where, limits);
  return std::move(reader.read()).mesh();
}
inline TriangleMesh read_ply_mesh(const std::filesystem::path& path, const PlyLimits& limits = {}) {
  return decode_ply_mesh(read_file(path, limits.bytes), path.string(), limits);
}

/// Decodes the points of a PLY file; faces do not count.
inline PointCloud decode_ply_points(std::string_view bytes, const std::string& where, const PlyLimits& limits = {}) {
  PlyReader reader(bytes, where, limits);
  return std::move(reader.read()).points();
}
inline PointCloud read_ply_points(const std::filesystem::path& path, const PlyLimits& limits = {}) {
  return decode_ply_points(read_file(path, limits.bytes), path.string(), limits);
}

}  // namespace vantage
