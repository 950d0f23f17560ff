#pragma once

#include <cstddef>

#include "plugins/real_time_check/real_time_hooks.h"

namespace runnel::test {

/// Counts what the calling thread takes from and gives back to the heap while the guard lives:
///
///     const AllocationGuard guard;
///     output.Publish(value);
///     EXPECT_EQ(guard.allocations(), 0u);
///
/// The program that links this library has its malloc family replaced by a counting one, for all
/// libraries in it; operator new comes through malloc.
///
/// Threads:  one guard belongs to one thread and sees only that thread. May be nested.
/// Under a sanitizer, which has a malloc of its own, nothing is counted: works() is false, and both
/// counts stay 0.
class AllocationGuard {
 public:
  [[nodiscard]] static bool works() noexcept { return RunnelRealTimeHooks()->works; }
  /// malloc, calloc, realloc, aligned_alloc and their like, and operator new.
  [[nodiscard]] std::size_t allocations() const noexcept {
    return RunnelRealTimeHooks()->counts().allocations - before_.allocations;
  }
  /// free() of something, and operator delete.
  [[nodiscard]] std::size_t releases() const noexcept {
    return RunnelRealTimeHooks()->counts().releases - before_.releases;
  }

 private:
  RealTimeHooks::Counts before_ = RunnelRealTimeHooks()->counts();
};

}  // namespace runnel::test
