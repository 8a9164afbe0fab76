// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <type_traits>

#include <vantage/concepts/explain.hpp>

namespace vantage::test {

template <class... Ts>
struct List {
  static constexpr std::size_t size = sizeof...(Ts);
};
template <std::size_t I, class L>
struct At;
template <std::size_t I, class T, class... Ts>
struct At<I, List<T, Ts...>> : At<I - 1, List<Ts...>> {};
template <class T, class... Ts>
struct At<0, List<T, Ts...>> {
  using type = T;
};
template <class... Ls>
struct Joined {
  using type = List<>;
};
template <class... A>
struct Joined<List<A...>> {
  using type = List<A...>;
};
template <class... A, class... B, class... Rest>
struct Joined<List<A...>, List<B...>, Rest...> : Joined<List<A..., B...>, Rest...> {};
template <class L, class Need>
struct Offering;  // the maps of a list that offer what is needed
template <class... Ts, class Need>
struct Offering<List<Ts...>, Need> : Joined<std::conditional_t<offers<Ts, Need>, List<Ts>, List<>>...> {};
template <template <class...> class To, class L>
struct Into;
template <template <class...> class To, class... Ts>
struct Into<To, List<Ts...>> {
  using type = To<Ts...>;
};

}  // namespace vantage::test
