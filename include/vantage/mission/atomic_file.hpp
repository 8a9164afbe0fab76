// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <vantage/core/error.hpp>

namespace vantage {

namespace detail {

/// Closes itself; every failure is a std::system_error that names the file.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags) : file_(file), fd_(::open(file.c_str(), flags, 0666)) {
    if (fd_ < 0) fail("cannot open ");
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { ::close(fd_); }

  void write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ::ssize_t n = ::write(fd_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("cannot write ");
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
  }
  /// To the disk. File systems that cannot do so for a folder say EINVAL, and need it not.
  void sync() const {
    if (::fsync(fd_) != 0 && errno != EINVAL) fail("cannot sync ");
  }

 private:
  [[noreturn]] void fail(const char* what) const {
    throw std::system_error(errno, std::generic_category(), what + file_.string());
  }
  std::filesystem::path file_;
  int fd_;
};

}  // namespace detail

/// Replaces `file` by `bytes`, or leaves it as it was: written beside (`file`.part), synced, renamed, and the folder
/// synced, so that neither kill -9 nor a power cut leaves half a file. The folder must exist. Throws std::system_error
/// (disk full, no permission). Two writers of one file must not run at once.
inline void write_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  const std::filesystem::path beside = file.string() + ".part";
  {
    const detail::Descriptor out(beside, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
    out.write(bytes);
    out.sync();
  }
  if (std::rename(beside.c_str(), file.c_str()) != 0)
    throw std::system_error(errno, std::generic_category(), "cannot rename " + beside.string());
  const std::filesystem::path folder = file.parent_path();
  detail::Descriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC).sync();
}

inline void write_atomically(const std::filesystem::path& file, std::string_view text) {
  write_atomically(file, std::as_bytes(std::span(text.data(), text.size())));
}

/// All bytes of `file`; none if it does not exist. Throws Error if it is no file or longer than `most_bytes`, and
/// std::system_error if it cannot be read.
inline std::optional<std::vector<std::byte>> read_bytes(
    const std::filesystem::path& file, std::uintmax_t most_bytes = std::numeric_limits<std::uintmax_t>::max()) {
  if (!std::filesystem::exists(file)) return std::nullopt;
  if (!std::filesystem::is_regular_file(file)) throw Error(file.string(), "not a file", "a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file);
  if (size > most_bytes) throw Error(file.string(), concat(size, " bytes"), concat("at most ", most_bytes));
  std::ifstream in(file, std::ios::binary);
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw std::system_error(errno, std::generic_category(), "cannot read " + file.string());
  return bytes;
}

}  // namespace vantage
