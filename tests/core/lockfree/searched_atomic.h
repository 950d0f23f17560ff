#pragma once

// The search over interleavings and weak memory: Relacy runs a few threads as fibers, decides at
// each atomic operation who goes on and which of the allowed values a load sees, and checks that
// plain data is never touched by two threads without a happens-before edge between them.

#include <atomic>
#include <cstdint>

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
  const bool acquires =
      ok == std::memory_order_acquire || ok == std::memory_order_acq_rel || ok == std::memory_order_seq_cst;
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
    return Living().compare_exchange(rl::bool_t<true>(), expected, desired, Searched(ok), SearchedFailure(ok, fail), $);
  }
  bool compare_exchange_strong(T& expected, T desired, std::memory_order ok, std::memory_order fail) {
    return Living().compare_exchange(rl::bool_t<false>(), expected, desired, Searched(ok), SearchedFailure(ok, fail),
                                     $);
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

}  // namespace runnel::test
