// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Any text as the description of a small mesh: refused with an Error, or a scene that fits together.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <vantage/io/obj.hpp>
#include <vantage/io/scene_json.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  static const LoadedScene mesh =
      ObjReader("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\no a\nf 1/1 2/1 3/1\no b\nf 3 2 1\n", "mesh", {})
          .read([](const std::string&) { return std::nullopt; }, "/nowhere");
  const std::string text(reinterpret_cast<const char*>(data), size);
  bool read = false;
  try {
    const nlohmann::json json = parse_json(text, "input", {.values = 4096});
    for (const LoadedScene& loaded : {mesh, LoadedScene{}}) {
      const Scene scene = SceneDescription(JsonItem(json, "input"), loaded).apply();
      read = true;
      if (!scene.mesh.empty()) scene.validate("scene");
      if (scene.start) check_view(*scene.start, "start");
      read = false;
    }
  } catch (const Error&) {
    if (read) std::abort();  // what a reader lets through is valid
  }
  return 0;
}
