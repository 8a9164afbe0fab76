// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cxxabi.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/loop/mission_state.hpp>
#include <vantage/version.hpp>

// A mission on disk, so that it survives the process. The file: magic, format, library version, then every part's type
// and bytes, then a checksum of all that. Little-endian (core/bytes.hpp).
namespace vantage {

namespace detail {

inline constexpr std::uint64_t checkpoint_magic = 0x74706B6365676E76ull;  // "vngeckpt"
inline constexpr std::uint32_t checkpoint_format = 1;

inline std::string readable(const std::string& type) {
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(type.c_str(), nullptr, nullptr, nullptr),
                                                    std::free);
  const std::string text = name ? name.get() : type;
  return text.size() <= 120 ? text : text.substr(0, 117) + "...";
}

template <Persistent T>
std::vector<std::byte> saved(const T& part) {
  Sink sink;
  part.save(sink);
  return std::move(sink).take();
}

template <Persistent T>
void restore(T& part, std::span<const std::byte> bytes, const std::string& where) {
  Source source(bytes, where);
  part.load(source);
  source.done();
}

}  // namespace detail

/// The parts as the bytes of a checkpoint.
template <Persistent... Parts>
std::vector<std::byte> checkpoint_bytes(const Parts&... parts) {
  Sink sink;
  sink.put(detail::checkpoint_magic);
  sink.put(detail::checkpoint_format);
  sink.put(std::string_view(VANTAGE_VERSION));
  sink.put(static_cast<std::uint32_t>(sizeof...(Parts)));
  const auto add = [&](const auto& part) {
    sink.put(std::string_view(typeid(part).name()));
    sink.put_saved(part);
  };
  (add(parts), ...);
  sink.put(fnv1a(sink.bytes()));
  return std::move(sink).take();
}

/// Sets the parts to what `checkpoint_bytes` saw. Throws Error, and changes nothing, if the bytes are damaged, cut
/// short, of another format or library version (which could go on differently), or of other types of parts. `where`
/// names the bytes in the message.
template <Persistent... Parts>
void restore_checkpoint(std::span<const std::byte> bytes, const std::string& where, Parts&... parts) {
  constexpr std::size_t trailer = sizeof(std::uint64_t);
  {
    Source head(bytes, where);
    if (bytes.size() < trailer || head.get<std::uint64_t>() != detail::checkpoint_magic)
      throw Error(where, "is no checkpoint", "a file that a mission wrote");
    const auto format = head.get<std::uint32_t>();
    if (format != detail::checkpoint_format)
      throw Error(where, concat("has format ", format), concat("format ", detail::checkpoint_format));
  }
  if (bytes.size() < 2 * trailer) throw Error(where, concat("ends at byte ", bytes.size()), "a whole checkpoint");
  const auto body = bytes.first(bytes.size() - trailer);
  if (Source(bytes.last(trailer), where).get<std::uint64_t>() != fnv1a(body))
    throw Error(where, "is damaged or cut short: its checksum differs", "the bytes that were written");

  Source source(body.subspan(sizeof detail::checkpoint_magic + sizeof detail::checkpoint_format), where);
  std::string version;
  source.get(version);
  if (version != VANTAGE_VERSION) throw Error(where, "was written by vantage " + version, "vantage " VANTAGE_VERSION);
  if (const auto n = source.get<std::uint32_t>(); n != sizeof...(Parts))
    throw Error(where, concat("holds ", n, " parts"),
                concat(sizeof...(Parts), ": the mission is composed of other policies"));
  std::vector<std::span<const std::byte>> found;
  const auto read = [&](const auto& part) {
    std::string type;
    source.get(type);
    if (type != typeid(part).name())
      throw Error(where, concat("part ", found.size(), " is a ", detail::readable(type)),
                  "a " + detail::readable(typeid(part).name()) + ": the mission is composed of other policies");
    found.push_back(source.get_bytes());
  };
  (read(parts), ...);
  source.done();

  // Every part checks before it changes; should a later one refuse, or one leave bytes over, all so far are set back.
  const std::vector<std::vector<std::byte>> before = {detail::saved(parts)...};
  std::size_t done = 0;
  try {
    ((detail::restore(parts, found[done], where), ++done), ...);
  } catch (...) {
    std::size_t i = 0;
    ((i <= done ? detail::restore(parts, before[i], where) : void(), ++i), ...);
    throw;
  }
}

struct CheckpointConfig {
  std::filesystem::path file = {};  ///< its folder must exist
  std::uint64_t every_steps = 1;    ///< measurements between two checkpoints, >= 1
  double every_s = 0;               ///< real time between two checkpoints, >= 0; both must have passed
  double most_share = 1;  ///< of real time that may go into writing, in (0, 1]: large maps are written less often
};

/// Observer that keeps a mission on disk: after a measurement, the map, the clock, the mission's state and whatever of
/// the world, the utility, the sampler, the selector and the riders (other observers, such as the Recorder) is
/// Persistent, in one file that is whole at any moment (io/file.hpp). It must come after its riders in the list of
/// observers. A policy with a memory that is not Persistent forgets it on resumption.
///
///     Checkpoint checkpoint(CheckpointConfig{.file = out / "mission.checkpoint"}, recorder);
///     MissionState state{.here = start, .rng = Rng(seed)};
///     if (resume) checkpoint.load(loop, world, clock, state);
///     loop.resume(world, state, first, stop, clock, recorder, checkpoint);
///
/// Cost: the parts are copied once and written to the disk.
template <Persistent... Riders>
class Checkpoint {
 public:
  explicit Checkpoint(CheckpointConfig config, Riders&... riders) : config_(std::move(config)), riders_(riders...) {
    Check check("CheckpointConfig");
    check(!config_.file.empty(), "file", config_.file.string(), "a file name");
    check(config_.every_steps >= 1, "every_steps", config_.every_steps, "at least 1");
    check.not_negative("every_s", config_.every_s);
    check(config_.most_share > 0 && config_.most_share <= 1, "most_share", config_.most_share, "in (0, 1]");
    check.done();
  }

  template <class Loop, class W, class C>
  void completed(const Loop& loop, const W& world, const C& clock, const MissionState& state) {
    const double since_s = seconds_since(saved_at_);
    if (state.visited.size() < saved_step_ + config_.every_steps || since_s < config_.every_s) return;
    if (since_s * config_.most_share < writing_s_ * (1 - config_.most_share)) return;
    save(loop, world, clock, state);
  }

  template <class Loop, class W, class C>
  void save(const Loop& loop, const W& world, const C& clock, const MissionState& state) {
    const auto began = std::chrono::steady_clock::now();
    write_file(config_.file, std::apply([](const auto&... parts) { return checkpoint_bytes(parts...); },
                                        parts(loop, world, clock, state)));
    saved_step_ = state.visited.size();
    saved_at_ = std::chrono::steady_clock::now();
    writing_s_ = std::chrono::duration<double>(saved_at_ - began).count();
  }

  /// Sets everything to the last checkpoint. False, and nothing changed, if there is none; throws Error, and nothing
  /// changed, if it is damaged or another mission's.
  template <class Loop, class W, class C>
  bool load(Loop& loop, W& world, C& clock, MissionState& state) {
    if (!std::filesystem::exists(config_.file)) return false;
    const std::string bytes = read_file(config_.file, std::numeric_limits<std::size_t>::max());
    const auto view = std::as_bytes(std::span(bytes.data(), bytes.size()));
    std::apply([&](auto&... parts) { restore_checkpoint(view, config_.file.string(), parts...); },
               parts(loop, world, clock, state));
    saved_step_ = state.visited.size();
    saved_at_ = std::chrono::steady_clock::now();
    return true;
  }

 private:
  static double seconds_since(std::chrono::steady_clock::time_point t) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
  }
  template <class T>
  static auto if_persistent(T& part) {
    if constexpr (Persistent<std::remove_const_t<T>>)
      return std::tie(part);
    else
      return std::tuple<>();
  }
  // The riders come first: a Recorder says best what is wrong with another mission's checkpoint.
  template <class Loop, class W, class C, class State>
  auto parts(Loop& loop, W& world, C& clock, State& state) const {
    static_assert(
        Persistent<typename Loop::MapType>,
        "vantage: a Checkpoint needs a Persistent map: give it `void save(Sink&) const` and `void load(Source&)`");
    static_assert(Persistent<std::remove_const_t<C>>,
                  "vantage: a Checkpoint needs a Persistent clock: use MeasuredClock or ModelledClock");
    return std::tuple_cat(riders_, std::tie(state, clock, loop.map), if_persistent(loop.utility),
                          if_persistent(loop.sampler), if_persistent(loop.selector), if_persistent(world));
  }

  CheckpointConfig config_;
  std::tuple<Riders&...> riders_;
  std::uint64_t saved_step_ = 0;
  double writing_s_ = 0;  // the last time
  std::chrono::steady_clock::time_point saved_at_ = std::chrono::steady_clock::now();
};

}  // namespace vantage
