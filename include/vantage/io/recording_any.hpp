// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/recording.hpp>
#include <vantage/io/recording_colmap.hpp>
#include <vantage/io/recording_folder.hpp>
#include <vantage/io/recording_replica.hpp>
#include <vantage/io/recording_transforms.hpp>
#include <vantage/io/recording_tum.hpp>

namespace vantage {

/// Reads a recording of any kind known here, by the files that it has: a transforms.json (or any other .json file), a
/// plain folder (camera.txt, poses.txt), TUM RGB-D (rgb.txt), Replica (traj.txt), or COLMAP (images.txt or images.bin,
/// in the folder, sparse/, sparse/0 or colmap/sparse/0; pictures in images/). Throws Error if it is none of these, and
/// what the kind's reader throws.
inline Recording read_recording(const std::filesystem::path& path) {
  if (file_exists(path)) {
    if (extension_of(path) == "json") return read_transforms_recording(path);
    throw Error(path.string(), "this is no recording", "a folder, or a transforms.json");
  }
  if (!folder_exists(path)) throw Error(path.string(), "no such file or folder");
  for (const char* name : {"transforms.json", "transforms_train.json"})
    if (file_exists(path / name)) return read_transforms_recording(path / name);
  if (file_exists(path / "poses.txt")) return read_folder_recording(path);
  if (file_exists(path / "rgb.txt")) return read_tum_recording(path);
  if (file_exists(path / "traj.txt")) return read_replica_recording(path);
  for (const std::filesystem::path& model :
       {path, path / "sparse", path / "sparse" / "0", path / "colmap" / "sparse" / "0"})
    if (file_exists(model / "images.txt") || file_exists(model / "images.bin"))
      return read_colmap_recording(model, folder_exists(path / "images") ? path / "images" : path);
  throw Error(path.string(), "this is no recording",
              "transforms.json, camera.txt and poses.txt, rgb.txt (TUM), traj.txt (Replica) or images.txt (COLMAP)");
}

}  // namespace vantage
