#pragma once

// The search over interleavings and weak memory: Relacy runs a few threads as fibers, decides at
// each atomic operation who goes on and which of the allowed values a load sees, and checks that
// plain data is never touched by two threads without a happens-before edge between them.

#include <array>
#include <atomic>
#include <cstdint>
#include <iostream>
#include <memory>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

// Relacy predates these warnings, and redefines words of the language, which are given back below.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#include <relacy/relacy.hpp>
#pragma GCC diagnostic pop
#undef memory_order_relaxed
#undef memory_order_consume
#undef memory_order_acquire
#undef memory_order_release
#undef memory_order_acq_rel
#undef memory_order_seq_cst
#undef new
#undef delete
#undef malloc
#undef calloc
#undef realloc
#undef free
#undef assert

#include "core/lockfree/asymmetric_fence.h"
#include "tests/core/lockfree/searched_fences.h"

namespace runnel::test {

template <typename T>
class SearchedAtomic;

}  // namespace runnel::test

template <>
struct runnel::Fences<runnel::test::SearchedAtomic> {
  static void Full() { test::SearchedFences::Pass(test::FenceKind::kFull); }
  static void Light() { test::SearchedFences::Pass(test::FenceKind::kLight); }
  static void Heavy() { test::SearchedFences::Pass(test::FenceKind::kHeavy); }
  static bool HeavyIsHeavy() { return true; }
  static void LightIfHeavyIsHeavy() { Light(); }
};

namespace runnel::test {

inline rl::memory_order Searched(std::memory_order order) {
  switch (order) {
    case std::memory_order_relaxed:
      return rl::mo_relaxed;
    case std::memory_order_consume:
    case std::memory_order_acquire:
      return rl::mo_acquire;
    case std::memory_order_release:
      return rl::mo_release;
    case std::memory_order_acq_rel:
      return rl::mo_acq_rel;
    case std::memory_order_seq_cst:
      return rl::mo_seq_cst;
  }
  return rl::mo_seq_cst;
}

/// Relacy takes no failure order above the order of success, as C++ did once. The structures have none
/// either; but they are weakened to see what the search says (weaken).
inline rl::memory_order SearchedFailure(std::memory_order ok, std::memory_order fail) {
  const bool acquires = ok == std::memory_order_acquire || ok == std::memory_order_acq_rel ||
                        ok == std::memory_order_seq_cst;
  return acquires ? Searched(fail) : rl::mo_relaxed;
}

/// Stands in for std::atomic in the structures under test. Its making and its end are no atomic
/// operations: the search reports one that is not ordered with every use.
template <typename T>
class SearchedAtomic {
 public:
  SearchedAtomic() : SearchedAtomic(T{}) {}
  SearchedAtomic(T value) {
    life_($) = 1;
    atomic_.store(value, rl::mo_relaxed, $);
  }
  ~SearchedAtomic() { life_($) = 0; }

  T load(std::memory_order order) const { return Living().load(Searched(order), $); }
  void store(T value, std::memory_order order) { Living().store(value, Searched(order), $); }
  T exchange(T value, std::memory_order order) {
    return Living().rmw(rl::rmw_type_t<rl::rmw_type_swap>(), value, Searched(order), $);
  }
  T fetch_add(T value, std::memory_order order) {
    return Living().rmw(rl::rmw_type_t<rl::rmw_type_add>(), value, Searched(order), $);
  }
  T fetch_sub(T value, std::memory_order order) {
    return Living().rmw(rl::rmw_type_t<rl::rmw_type_sub>(), value, Searched(order), $);
  }
  T fetch_or(T value, std::memory_order order) {
    return Living().rmw(rl::rmw_type_t<rl::rmw_type_or>(), value, Searched(order), $);
  }
  bool compare_exchange_weak(T& expected, T desired, std::memory_order ok, std::memory_order fail) {
    return Living().compare_exchange(rl::bool_t<true>(), expected, desired, Searched(ok),
                                     SearchedFailure(ok, fail), $);
  }
  bool compare_exchange_strong(T& expected, T desired, std::memory_order ok,
                               std::memory_order fail) {
    return Living().compare_exchange(rl::bool_t<false>(), expected, desired, Searched(ok),
                                     SearchedFailure(ok, fail), $);
  }

 private:
  const rl::atomic<T>& Living() const {
    (void)static_cast<int>(life_($));
    return atomic_;
  }
  rl::atomic<T>& Living() {
    (void)static_cast<int>(life_($));
    return atomic_;
  }

  mutable rl::var<int> life_;
  rl::atomic<T> atomic_;
};

/// Plain data: the search reports two threads that touch it without an order between them.
class SearchedPlain {
 public:
  SearchedPlain() { Set(0); }
  explicit SearchedPlain(int value) { Set(value); }
  SearchedPlain(SearchedPlain&& other) noexcept { Set(other.Get()); }
  SearchedPlain& operator=(SearchedPlain&& other) noexcept {
    Set(other.Get());
    return *this;
  }
  [[nodiscard]] int Get() const { return value_($); }
  void Set(int value) { value_($) = value; }

 private:
  mutable rl::var<int> value_;
};

/// What the search prints, in room of its own: it has an operator new of its own too, and must not
/// be asked for memory while it reports. What does not fit is left out.
class SearchOutput : public std::streambuf {
 public:
  SearchOutput() { setp(room_.data(), room_.data() + room_.size()); }
  [[nodiscard]] std::string_view text() const {
    return {pbase(), static_cast<std::size_t>(pptr() - pbase())};
  }

 private:
  int_type overflow(int_type) override { return 0; }
  std::array<char, 1 << 16> room_;
};

/// The suite with fences of its own, which are there before it.
template <typename Suite>
struct WithFences : SearchedFencesOf<Suite::params::thread_count>, Suite {};

/// Runs `Suite` through schedules as `parameters` say; how many, or 0 if one failed, which is printed.
template <typename Suite>
rl::iteration_t CountPassed(rl::test_params parameters) {
  parameters.progress_output_period = 1000000000;
  parameters.execution_depth_limit = 10000;
  const auto room = std::make_unique<SearchOutput>();
  std::ostream output(room.get());
  parameters.output_stream = &output;
  parameters.progress_stream = &output;
  if (rl::simulate<WithFences<Suite>>(parameters)) return parameters.stop_iteration;
  std::cout << room->text() << std::endl;
  return 0;
}

/// Runs `Suite` through `iterations` random schedules; true if none failed.
template <typename Suite>
bool SearchAtRandom(unsigned iterations) {
  rl::test_params parameters;
  parameters.iteration_count = iterations;
  parameters.search_type = rl::random_scheduler_type;
  return CountPassed<Suite>(parameters) > 0;
}

/// Runs `Suite` through each schedule in which threads are interrupted `interruptions` times at most,
/// besides where they end or wait; true if none failed. What a random schedule comes upon once in
/// millions, as one thread that stands still while others do much, is among them.
template <typename Suite>
bool SearchAll(unsigned interruptions) {
  rl::test_params parameters;
  parameters.search_type = rl::fair_context_bound_scheduler_type;
  parameters.context_bound = interruptions;
  const rl::iteration_t passed = CountPassed<Suite>(parameters);
  testing::Test::RecordProperty("schedules", std::to_string(passed));
  return passed > 0;
}

/// Both: `iterations` at random, and all with so many interruptions.
template <typename Suite>
bool Search(unsigned iterations, unsigned interruptions) {
  return SearchAll<Suite>(interruptions) && SearchAtRandom<Suite>(iterations);
}

}  // namespace runnel::test
