#pragma once

#include <cstddef>

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
  AllocationGuard() noexcept;

  [[nodiscard]] static bool works() noexcept;
  /// malloc, calloc, realloc, aligned_alloc and their like, and operator new.
  [[nodiscard]] std::size_t allocations() const noexcept;
  /// free() of something, and operator delete.
  [[nodiscard]] std::size_t releases() const noexcept;

 private:
  std::size_t allocations_before_;
  std::size_t releases_before_;
};

}  // namespace runnel::test
