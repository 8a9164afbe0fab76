// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <ostream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/mission/text.hpp>
#include <vantage/version.hpp>

// What every mission's command line shares, and how every program ends.
namespace vantage {

/// Exit codes of all programs.
enum class Exit : int { done = 0, failed = 1, bad_input = 2 };

enum class ClockKind { real, modelled };
enum class PresetKind { thesis, reference };

/// A method's name on the command line and what it is, for --list-methods.
struct MethodName {
  std::string name, about;
};

/// The options that all missions share; the members' values are the defaults that --help shows.
struct MissionOptions {
  std::filesystem::path out = {};  ///< folder of the results
  std::uint64_t seed = 7;
  int threads = 0;  ///< 0: as many as there are cores
  ClockKind clock = ClockKind::real;
  PresetKind preset = PresetKind::thesis;
  std::string method = "ours";
  double budget_s = std::numeric_limits<double>::infinity();  ///< mission time
  std::uint64_t measurements = std::numeric_limits<std::uint64_t>::max();
  double travel_m = std::numeric_limits<double>::infinity();
  bool resume = false;
  std::vector<std::string> command = {};  ///< the words of the command line, for the report
};

/// The clock that --clock asked for: one type, so that a program's loops are compiled once.
class MissionClock {
 public:
  explicit MissionClock(ClockKind kind, const ModelledClock::Config& costs = {}) : kind_(kind), modelled_(costs) {}
  [[nodiscard]] double elapsed_s() const {
    return kind_ == ClockKind::real ? measured_.elapsed_s() : modelled_.elapsed_s();
  }
  void begin() { measured_.begin(); }
  void mapped() { measured_.mapped(), modelled_.mapped(); }
  void planned() { measured_.planned(), modelled_.planned(); }
  void travelled(double s) { measured_.travelled(s), modelled_.travelled(s); }
  void save(Sink& sink) const { kind_ == ClockKind::real ? measured_.save(sink) : modelled_.save(sink); }
  void load(Source& source) { kind_ == ClockKind::real ? measured_.load(source) : modelled_.load(source); }

 private:
  ClockKind kind_;
  MeasuredClock measured_;
  ModelledClock modelled_;
};

inline std::string_view name_of(ClockKind clock) { return clock == ClockKind::real ? "real" : "modelled"; }
inline std::string_view name_of(PresetKind preset) { return preset == PresetKind::thesis ? "thesis" : "reference"; }

namespace detail {

/// --list-methods: ends the program like --help does.
struct ListMethods : CLI::CallForVersion {
  explicit ListMethods(const std::vector<MethodName>& methods) : CLI::CallForVersion(text(methods), 0) {}
  static std::string text(const std::vector<MethodName>& methods) {
    std::size_t width = 0;
    for (const MethodName& m : methods) width = std::max(width, m.name.size());
    std::string s;
    for (const MethodName& m : methods)
      s += (s.empty() ? "" : "\n") + m.name + std::string(width + 2 - m.name.size(), ' ') + m.about;
    return s;
  }
};

/// Digits only, and no more than fit: CLI11 reads "-1" as a huge unsigned number, and a huger one as the largest.
inline CLI::Validator whole_number() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t unused = 0;
        const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), unused);
        return failed == std::errc() && end == text.data() + text.size()
                   ? std::string()
                   : concat("'", text, "' is no whole number up to ", std::numeric_limits<std::uint64_t>::max());
      },
      "");
}

/// The number that the whole text is, or NaN if it is none or infinite.
inline double finite_number(const std::string& text) {
  char* end = nullptr;
  const double x = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(x) ? x : std::numeric_limits<double>::quiet_NaN();
}
inline CLI::Validator positive() {
  return CLI::Validator(
      [](std::string& text) {
        return finite_number(text) > 0 ? std::string() : "'" + text + "' is no finite number above 0";
      },
      "> 0");
}
/// Numbers from `low` to `high`. CLI::Range lets NaN pass.
inline CLI::Validator between(double low, double high) {
  const std::string range = concat(low, " to ", high);
  return CLI::Validator(
      [low, high, range](std::string& text) {
        const double x = finite_number(text);
        return x >= low && x <= high ? std::string() : "'" + text + "' is no number from " + range;
      },
      range);
}

/// The values of an enumeration by their names, name_of(value), alone. CLI::CheckedTransformer takes numbers, too.
template <class E>
CLI::Validator one_of(const std::vector<E>& values) {
  return CLI::Validator(
      [values](std::string& text) {
        std::string names;
        for (const E value : values) {
          if (text == name_of(value)) {
            text = std::to_string(static_cast<int>(value));
            return std::string();
          }
          names.append(names.empty() ? "" : ", ").append(name_of(value));
        }
        return "'" + text + "' is none of " + names;
      },
      "");
}

inline std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace detail

/// Adds the shared options to `app`. `options` and what it holds must outlive the parsing.
inline void add_mission_options(CLI::App& app, MissionOptions& options, const std::vector<MethodName>& methods) {
  std::vector<std::string> names;
  names.reserve(methods.size());
  for (const MethodName& m : methods) names.push_back(m.name);
  const CLI::Validator positive = detail::positive(), whole = detail::whole_number();

  app.set_version_flag("--version", "vantage " VANTAGE_VERSION);
  app.add_option("--out", options.out, "Folder of the results")->capture_default_str()->type_name("DIR");
  app.add_option("--seed", options.seed, "Seed of everything random")
      ->check(whole)
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--threads", options.threads, "Threads; 0: all cores (no result depends on it)")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--method", options.method, "Method, or a baseline (see --list-methods)")
      ->check(CLI::IsMember(names))
      ->capture_default_str()
      ->type_name("NAME");
  app.add_flag_callback(
         "--list-methods", [methods] { throw detail::ListMethods(methods); }, "List the methods")
      ->trigger_on_parse();
  app.add_option("--preset", options.preset, "Where the thesis and the published code disagree: thesis or reference")
      ->transform(detail::one_of<PresetKind>({PresetKind::thesis, PresetKind::reference}))
      ->default_str(std::string(name_of(options.preset)))
      ->type_name("NAME");
  app.add_option("--clock", options.clock,
                 "Mission time of computing: real (measured) or modelled (a run repeats bit for bit)")
      ->transform(detail::one_of<ClockKind>({ClockKind::real, ClockKind::modelled}))
      ->default_str(std::string(name_of(options.clock)))
      ->type_name("NAME");
  app.add_option("--budget", options.budget_s, "Mission time: planning + mapping + flight")
      ->check(positive)
      ->default_str(std::isfinite(options.budget_s) ? short_number(options.budget_s) : "none")
      ->type_name("SECONDS");
  app.add_option("--measurements", options.measurements, "Stop after so many measurements")
      ->check(whole)
      ->check(positive)
      ->type_name("N");
  app.add_option("--travel", options.travel_m, "Stop after so long a way")->check(positive)->type_name("METRES");
  app.add_flag("--resume", options.resume, "Go on from the last checkpoint in the results' folder, if there is one");
}

/// f() with the given number of threads for parallel work (0, or more than there are: all cores).
template <class F>
decltype(auto) with_threads(int threads, F&& f) {
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(threads == 0 ? cores : std::min(threads, cores));
  return arena.execute(std::forward<F>(f));
}

/// The folder, made if need be. Throws Error (a wrong --out is bad input) if that cannot be.
inline void make_folder(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed || !std::filesystem::is_directory(folder, failed))
    throw Error("--out",
                concat("cannot make the folder ", folder.string(), failed ? " (" + failed.message() + ")" : ""),
                "a folder to write to");
}

/// Parses the command line and runs `f()`. Returns the exit code: 0 done (also --help, --version, --list-methods, which
/// write to `out`); 2 bad usage or input (a parse error or vantage::Error); 1 anything else. What went wrong is one
/// line on `err`.
template <std::invocable F>
int run_program(CLI::App& app, int argc, const char* const* argv, std::ostream& out, std::ostream& err, F&& f) {
  const auto fail = [&](Exit code, const std::string& what) {
    err << app.get_name() << ": " << detail::one_line(what) << std::endl;
    return static_cast<int>(code);
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) { return app.exit(e, out, err); } catch (const CLI::ParseError& e) {
    return fail(Exit::bad_input, std::string(e.what()) + " (see --help)");
  }
  try {
    f();
    return static_cast<int>(Exit::done);
  } catch (const Error& e) { return fail(Exit::bad_input, e.what()); } catch (const std::bad_alloc&) {
    return fail(Exit::failed, "out of memory");
  } catch (const std::exception& e) { return fail(Exit::failed, e.what()); } catch (...) {
    return fail(Exit::failed, "an unknown error");
  }
}

}  // namespace vantage
