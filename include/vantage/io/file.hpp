// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include <vantage/core/error.hpp>

namespace vantage {

/// Whether there is a regular file of this name; a name that no file can have is none.
inline bool file_exists(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

/// Whether there is a folder of this name; a name that no folder can have is none.
inline bool folder_exists(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

/// The kind of a file by its name: "obj" of "a/b.OBJ"; "" if it has none.
inline std::string extension_of(const std::filesystem::path& path) {
  std::string e = path.extension().string();
  if (!e.empty()) e.erase(0, 1);
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

/// The whole of a regular file. Throws Error if it cannot be read or is larger than `most_bytes`, before anything of
/// its size is allocated.
inline std::string read_file(const std::filesystem::path& path, std::size_t most_bytes) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(path, failed);
  if (status.type() == std::filesystem::file_type::not_found) throw Error(path.string(), "no such file");
  if (!std::filesystem::is_regular_file(status)) throw Error(path.string(), "this is no regular file", "a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string(), concat("cannot be opened: ", std::strerror(errno)));
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed) throw Error(path.string(), concat("cannot be read: ", failed.message()));
  if (size > most_bytes) throw Error(path.string(), concat(size, " bytes"), concat("at most ", most_bytes));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

/// Writes a file so that a crash leaves either the old one or the new one, whole: writes `path`.part, syncs it to the
/// disk, renames it. Throws Error (the old file stays) if the folder does not exist, the disk is full, ...
inline void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::string part = path.string() + ".part";
  const int file = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  bool good = file >= 0;
  int reason = errno;
  const auto did = [&](bool success) {
    if (good && !success) reason = errno;
    good = good && success;
  };
  for (std::size_t at = 0; good && at < bytes.size();) {
    const ssize_t n = write(file, bytes.data() + at, bytes.size() - at);
    did(n > 0 || (n < 0 && errno == EINTR));
    if (n > 0) at += static_cast<std::size_t>(n);
  }
  if (good) did(fsync(file) == 0);
  if (file >= 0) did(close(file) == 0);
  if (good) did(std::rename(part.c_str(), path.c_str()) == 0);
  if (!good) {
    if (file >= 0) unlink(part.c_str());
    throw Error(path.string(), concat("cannot be written: ", std::strerror(reason)));
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  if (const int directory = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); directory >= 0) {
    fsync(directory);  // the new name, too
    close(directory);
  }
}
inline void write_file(const std::filesystem::path& path, std::string_view text) {
  write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace vantage
