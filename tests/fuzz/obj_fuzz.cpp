// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any text as an OBJ and, after a byte 1, its MTL: refused with an Error, or a scene that fits together.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include <vantage/io/obj.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const std::size_t cut = text.find('\1');
  const auto library = [&](const std::string&) {
    return cut == text.npos ? std::nullopt : std::optional(text.substr(cut + 1));
  };
  bool read = false;
  try {
    const LoadedScene loaded =
        ObjReader(text.substr(0, cut), "input", {.triangles = 4096, .textures = 4}).read(library, "/nowhere");
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
