#pragma once

#include <cstddef>

namespace runnel {

/// What a thread does that no cycle should.
enum class RealTimeOffence { kAllocation, kRelease, kLock, kSystemCall };

/// What stands between a program and the functions of the C library that allocate and lock. In a program that links
/// runnel::real_time_hooks, and in one that has the library runnel_real_time_hooks preloaded, these functions are
/// replaced for all libraries in it. They count, tell whoever listens in that thread, and then do what they always do.
///
/// Threads:     all is of the calling thread alone.
/// Allocation:  none. Errors: none.
struct RealTimeHooks {
  struct Counts {
    std::size_t allocations = 0;  ///< malloc, calloc, realloc, aligned_alloc and their like, and operator new
    std::size_t releases = 0;     ///< free() of something, and operator delete
    std::size_t locks = 0;        ///< mutexes and reader-writer locks taken, or tried; none inside of the C library
  };
  /// Called before the act, with the function's name and to where it returns. What it does itself is neither counted
  /// nor told.
  using Listener = void (*)(RealTimeOffence offence, const char* function, const void* caller) noexcept;

  /// Under a sanitizer, which replaces the same functions, nothing is counted or told.
  bool works;
  Counts (*counts)() noexcept;  ///< since the thread began
  /// nullptr: nobody.
  void (*Listen)(Listener listener) noexcept;
  /// Whether the thread is in one of the replaced functions, and that has been told.
  bool (*is_within)() noexcept;
};

}  // namespace runnel

/// Under this name whoever has been preloaded is found.
extern "C" const runnel::RealTimeHooks* RunnelRealTimeHooks() noexcept;
