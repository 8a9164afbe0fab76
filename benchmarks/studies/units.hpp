// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/mission/text.hpp>

// A study as many small units of work, each with a result file of its own: it may be interrupted at any time and
// started again, or spread over machines that share a folder.
namespace study {

using Json = nlohmann::ordered_json;

/// One run of a study: a name that is good as a file's, and all that determines the result.
struct Unit {
  std::string name;
  Json parameters;
};

/// Part `index` (0-based) of `count`: every count-th unit.
struct Shard {
  std::size_t index = 0, count = 1;

  /// From "i/n", 1 <= i <= n <= 65536. Throws Error for anything else.
  static Shard parse(std::string_view text) {
    const auto number = [](std::string_view digits) -> std::optional<std::size_t> {
      std::size_t n = 0;
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
      if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
      return n;
    };
    const std::size_t slash = text.find('/');
    const auto i = number(text.substr(0, slash));
    const auto n = slash == text.npos ? std::nullopt : number(text.substr(slash + 1));
    if (!i || !n || *i < 1 || *i > *n || *n > 65536)
      throw vantage::Error("--shard", "'" + std::string(text) + "'", "i/n with 1 <= i <= n <= 65536, such as 2/8");
    return {*i - 1, *n};
  }
  [[nodiscard]] bool holds(std::size_t unit) const { return unit % count == index; }
};

/// Held while a unit runs: units measure time, so processes of one machine that share a folder take turns. The lock
/// goes with the process, whatever ends it.
class Alone {
 public:
  explicit Alone(const std::filesystem::path& folder) {
    char host[256] = {};
    ::gethostname(host, sizeof host - 1);
    const std::string path = (folder / (std::string(".alone.") + host)).string();
    file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    int locked = -1;
    if (file_ >= 0) do
        locked = ::flock(file_, LOCK_EX);
      while (locked != 0 && errno == EINTR);
    if (locked != 0) {
      const std::string reason = std::strerror(errno);
      if (file_ >= 0) ::close(file_);
      throw vantage::Error(path, "cannot be locked: " + reason);
    }
  }
  ~Alone() { ::close(file_); }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  int file_ = -1;
};

/// The result files of a study's units: FOLDER/NAME.json, each {"parameters": ..., "load_average": ..., "result": ...},
/// written whole or not at all.
class Units {
 public:
  /// Makes the folder. Throws Error if that cannot be.
  explicit Units(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::error_code failed;
    std::filesystem::create_directories(folder_, failed);
    if (failed) throw vantage::Error(folder_.string(), "cannot be made: " + failed.message(), "a folder to write to");
  }

  /// The result of a unit that has run. Throws Error if its file is damaged or belongs to other parameters: results of
  /// different studies are never mixed.
  [[nodiscard]] std::optional<Json> result(const Unit& unit) const {
    const std::optional<Json> document = read(unit);
    return document ? std::optional((*document)["result"]) : std::nullopt;
  }

  /// The machine's load average when the busiest of these units began, of those that have run: well above what the
  /// study's own threads make, its times are worth little.
  [[nodiscard]] double busiest(std::span<const Unit> units) const {
    double most = 0;
    for (const Unit& u : units)
      if (const auto document = read(u)) most = std::max(most, document->value("load_average", 0.0));
    return most;
  }

  /// Runs f(unit) -> Json, one at a time, for the units of the shard that have no result yet, and writes what it gives.
  /// Returns how many it ran. One line a unit on `log`.
  template <class F>
  std::size_t run(std::span<const Unit> units, const Shard& shard, std::ostream& log, F&& f) const {
    check_names(units);
    std::vector<const Unit*> mine;
    for (std::size_t i = 0; i < units.size(); ++i)
      if (shard.holds(i)) mine.push_back(&units[i]);
    std::size_t ran = 0;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const Unit& unit = *mine[i];
      if (result(unit)) continue;
      const Alone alone(folder_);
      if (result(unit)) continue;  // somebody else's, while we waited
      double load = 0;
      if (::getloadavg(&load, 1) != 1) load = 0;
      const Json document = {{"parameters", unit.parameters}, {"load_average", load}, {"result", f(unit)}};
      vantage::write_file(file(unit), document.dump(1) + "\n");
      ++ran;
      const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      log << i + 1 << " of " << mine.size() << "  " << unit.name << "  " << vantage::short_time(s) << std::endl;
    }
    return ran;
  }

 private:
  [[nodiscard]] std::optional<Json> read(const Unit& unit) const {
    const std::filesystem::path path = file(unit);
    if (!std::filesystem::exists(path)) return std::nullopt;
    Json document = Json::parse(vantage::read_file(path, 1u << 28), nullptr, false);
    if (!document.is_object() || !document.contains("parameters") || !document.contains("result"))
      throw vantage::Error(path.string(), "this is no result of a unit",
                           "a file that this study wrote; delete it to run the unit again");
    if (document["parameters"] != unit.parameters)
      throw vantage::Error(path.string(), "made with " + document["parameters"].dump(),
                           unit.parameters.dump() + "; take another --out");
    return document;
  }
  [[nodiscard]] std::filesystem::path file(const Unit& unit) const { return folder_ / (unit.name + ".json"); }
  static void check_names(std::span<const Unit> units) {
    std::set<std::string_view> names;
    for (const Unit& u : units) {
      const bool good = !u.name.empty() && u.name.front() != '.' && u.name.find('/') == u.name.npos;
      if (!good || !names.insert(u.name).second)
        throw vantage::Error("Units::run", "a unit's name is '" + u.name + "'", "names of files, all different");
    }
  }
  std::filesystem::path folder_;
};

}  // namespace study
