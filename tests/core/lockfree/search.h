#pragma once

// Runs suites of a few threads through schedules.

#include <cstddef>
#include <memory>
#include <new>
#include <string>

#include <gtest/gtest.h>

#include "tests/core/lockfree/searched_atomic.h"

namespace runnel::test {

/// A suite as the search calls it: the search is compiled once for each number of threads, not once
/// for each suite.
struct SearchedSuite {
  rl::thread_id_t thread_count;
  void (*construct)();
  void (*before)();
  void (*thread)(unsigned index);
  void (*after)();
  void (*invariant)();
  void (*destroy)();
};

/// Where the one object of `Suite` lives while its search runs.
template <typename Suite>
class SuiteInstance {
  alignas(Suite) inline static std::byte memory_[sizeof(Suite)];

  static Suite& Get() { return *std::launder(reinterpret_cast<Suite*>(memory_)); }

 public:
  static constexpr SearchedSuite kCalls{
      Suite::params::thread_count,     [] { std::construct_at(reinterpret_cast<Suite*>(memory_)); },
      [] { Get().before(); },          [](unsigned index) { Get().thread(index); },
      [] { Get().after(); },           [] { Get().invariant(); },
      [] { std::destroy_at(&Get()); },
  };
};

/// Runs a suite through schedules as `parameters` say; how many, or 0 if one failed, which is printed.
rl::iteration_t CountPassed(const SearchedSuite& suite, rl::test_params parameters);

/// Runs `Suite` through `iterations` random schedules; true if none failed.
template <typename Suite>
bool SearchAtRandom(unsigned iterations) {
  rl::test_params parameters;
  parameters.iteration_count = iterations;
  parameters.search_type = rl::random_scheduler_type;
  return CountPassed(SuiteInstance<Suite>::kCalls, parameters) > 0;
}

/// Runs `Suite` through each schedule in which threads are interrupted `interruptions` times at most,
/// besides where they end or wait; true if none failed. What a random schedule comes upon once in
/// millions, as one thread that stands still while others do much, is among them.
template <typename Suite>
bool SearchAll(unsigned interruptions) {
  rl::test_params parameters;
  parameters.search_type = rl::fair_context_bound_scheduler_type;
  parameters.context_bound = interruptions;
  const rl::iteration_t passed = CountPassed(SuiteInstance<Suite>::kCalls, parameters);
  testing::Test::RecordProperty("schedules", std::to_string(passed));
  return passed > 0;
}

/// Both: `iterations` at random, and all with so many interruptions.
template <typename Suite>
bool Search(unsigned iterations, unsigned interruptions) {
  return SearchAll<Suite>(interruptions) && SearchAtRandom<Suite>(iterations);
}

}  // namespace runnel::test
