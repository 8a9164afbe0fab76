// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any bytes as a glTF file, JSON or binary: refused with an Error, or a scene that fits together.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/gltf.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const SceneLimits limits{.bytes = 1 << 20, .triangles = 4096, .texture_pixels = 1 << 14, .textures = 4};
  bool read = false;
  try {
    const LoadedScene loaded = GltfReader(bytes, "input", limits).read("/nowhere");
    read = true;
    loaded.scene.validate("scene");
    if (loaded.part.size() != loaded.scene.mesh.triangles.size()) std::abort();
    for (const std::uint32_t part : loaded.part)
      if (part >= loaded.parts.size()) std::abort();
  } catch (const Error&) {
    if (read) std::abort();  // what a reader lets through is valid
  }
  return 0;
}
