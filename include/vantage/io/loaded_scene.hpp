// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/printable.hpp>
#include <vantage/io/read_picture.hpp>

namespace vantage {

/// What a scene may cost; whatever is larger is refused before it is allocated.
struct SceneLimits {
  std::size_t bytes = std::size_t{2} << 30;  ///< of each file but pictures
  std::size_t triangles = std::size_t{1} << 25;
  std::size_t texture_pixels = std::size_t{1} << 29;  ///< of all textures
  std::size_t textures = 4096;
  PictureLimits picture = {};
};

/// A scene and what its file called the parts of it.
struct LoadedScene {
  Scene scene;
  std::vector<std::string> parts;   ///< OBJ objects or groups, glTF nodes; each name once
  std::vector<std::uint32_t> part;  ///< of each triangle, which of parts

  /// A line in Scene::notes, unless it stands there or there are a hundred.
  void note(const std::string& line) {
    if (scene.notes.size() > 100 || std::find(scene.notes.begin(), scene.notes.end(), line) != scene.notes.end())
      return;
    scene.notes.push_back(scene.notes.size() < 100 ? line : "and more");
  }
};

/// Gathers the pictures that a scene's materials name, each once, and decodes them together.
class TextureLoader {
 public:
  explicit TextureLoader(const SceneLimits& limits) : limits_(limits) {}

  /// What a material holds in place of its texture until `load`.
  std::uint32_t from_file(const std::filesystem::path& path) {
    return add(path.lexically_normal().string(), [&] { return Source{path.string(), path, {}}; });
  }
  std::uint32_t from_bytes(const std::string& name, std::string bytes) {
    return add("\n" + name, [&] { return Source{name, {}, std::move(bytes)}; });
  }

  /// Decodes all pictures, concurrently, into the scene's textures. One that is missing or damaged becomes a note, and
  /// the materials that use it show their colour. Throws Error if there are too many pixels.
  void load(LoadedScene& loaded) {
    const std::size_t n = sources_.size();
    std::vector<std::size_t> pixels(n, 0);
    std::vector<std::string> complaint(n);
    std::vector<std::optional<Texture>> textures(n);
    const auto trying = [&](std::size_t i, auto&& f) {
      if (!complaint[i].empty()) return;
      try {
        f(sources_[i]);
      } catch (const Error& e) { complaint[i] = e.what(); }
    };
    parallel_for(n, [&](std::size_t i) {
      trying(i, [&](Source& s) {
        if (!s.path.empty()) s.bytes = read_file(s.path, limits_.picture.bytes);
        pixels[i] = coded_pixels(s.bytes, s.name, limits_.picture);
      });
    });
    std::size_t sum = 0;
    for (const std::size_t p : pixels) sum += p;
    if (sum > limits_.texture_pixels)
      throw Error("textures", concat(sum, " pixels in all"), concat("at most ", limits_.texture_pixels));
    parallel_for(n, [&](std::size_t i) {
      trying(i, [&](Source& s) {
        textures[i] = to_texture(decode_picture(s.bytes, s.name, limits_.picture));
        s.bytes = {};
      });
    });

    std::vector<std::optional<std::uint32_t>> index(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (textures[i]) {
        index[i] = static_cast<std::uint32_t>(loaded.scene.textures.size());
        loaded.scene.textures.push_back(*std::move(textures[i]));
      } else {
        loaded.note("texture replaced by its material's colour: " + complaint[i]);
      }
    }
    for (Material& m : loaded.scene.materials)
      if (m.texture) m.texture = index[*m.texture];
  }

 private:
  struct Source {
    std::string name;
    std::filesystem::path path;
    std::string bytes;
  };
  template <class Make>
  std::uint32_t add(const std::string& key, Make&& make) {
    const auto [it, fresh] = known_.emplace(key, static_cast<std::uint32_t>(sources_.size()));
    if (fresh) {
      if (sources_.size() == limits_.textures)
        throw Error("textures", concat("more than ", limits_.textures, " pictures"), "fewer");
      sources_.push_back(make());
    }
    return it->second;
  }

  SceneLimits limits_;
  std::map<std::string, std::uint32_t> known_;
  std::vector<Source> sources_;
};

}  // namespace vantage
