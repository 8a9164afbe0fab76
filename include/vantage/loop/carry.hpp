// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include <vantage/concepts/map.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/rng.hpp>

namespace vantage {

/// A map that can say beforehand whether it would refuse a measurement: `check` throws Error exactly when `integrate`
/// would refuse. Optional; it saves Carry a copy of the map per measurement.
template <class M>
concept ForetellsRefusal = Map<M> && requires(const M m, const typename M::Measurement& z) {
  m.check(z);
};

/// A map that is planned on, and riders that learn from the same measurements (explicit beside implicit, surfels beside
/// voxels). To utilities, samplers and selectors it is the planned map, with all that this offers.
///
///     NbvLoop loop{Carry{voxels, surfels}, ...};      // std::get<0>(loop.map.riders) is the surfel map
///
/// If any of the maps refuses a measurement, none of them has changed. Riders with a `check` (ForetellsRefusal) are
/// asked first; the others learn on a copy that is kept only if all accept, so they must be copyable. As with any map,
/// a bad_alloc leaves every one of them valid, but it may find the measurement in some and not in others. The planned
/// map draws from `rng` what it would without riders; each rider draws from a stream of its own.
template <Map Planned, Map... Riders>
class Carry : public Planned {
  static_assert((std::same_as<typename Planned::Measurement, typename Riders::Measurement> && ...),
                "vantage: all maps of a Carry must learn from the same type of Measurement");
  static_assert(
      ((ForetellsRefusal<Riders> || std::copyable<Riders>)&&...),
      "vantage: a rider must be copyable, or tell beforehand: give it `void check(const Measurement&) const`");

 public:
  std::tuple<Riders...> riders;

  explicit Carry(Planned planned, Riders... r) : Planned(std::move(planned)), riders(std::move(r)...) {}

  void integrate(const typename Planned::Measurement& z, Rng& rng) {
    integrate(z, rng, std::index_sequence_for<Riders...>{});
  }

  void save(Sink& sink) const requires(Persistent<Planned>&&...&& Persistent<Riders>) {
    Planned::save(sink);
    std::apply([&](const Riders&... r) { (r.save(sink), ...); }, riders);
  }
  /// Loads into copies first: all maps change or none.
  void load(Source& source) requires((Persistent<Planned> && std::copyable<Planned>)&&... &&
                                     (Persistent<Riders> && std::copyable<Riders>)) {
    Planned planned(*this);
    std::tuple<Riders...> loaded(riders);
    planned.load(source);
    std::apply([&](Riders&... r) { (r.load(source), ...); }, loaded);
    static_cast<Planned&>(*this) = std::move(planned);
    riders = std::move(loaded);
  }

 private:
  template <std::size_t... Is>
  void integrate(const typename Planned::Measurement& z, Rng& rng, std::index_sequence<Is...>) {
    const Rng forks = rng;  // as it was, before the planned map draws
    std::tuple<std::optional<Riders>...> copies;
    (foretell(std::get<Is>(riders), std::get<Is>(copies), z, forks.fork(Is)), ...);
    Planned::integrate(z, rng);  // the last that may refuse
    (commit(std::get<Is>(riders), std::get<Is>(copies), z, forks.fork(Is)), ...);
  }
  template <class M>
  static void foretell(const M& map, std::optional<M>& copy, const typename M::Measurement& z, Rng rng) {
    if constexpr (ForetellsRefusal<M>) {
      map.check(z);
    } else {
      copy.emplace(map);
      copy->integrate(z, rng);
    }
  }
  template <class M>
  static void commit(M& map, std::optional<M>& copy, const typename M::Measurement& z, Rng rng) {
    if constexpr (ForetellsRefusal<M>)
      map.integrate(z, rng);
    else
      map = std::move(*copy);
  }
};

}  // namespace vantage
