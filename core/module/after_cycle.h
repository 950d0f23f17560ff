#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace runnel {

/// Work that the thread of a cycle does itself when all modules of the cycle have run: what calls the system, where it
/// would take longer to wake another thread for it. It lengthens the cycle, so it must be short.
///
/// Ownership:   whoever makes it lets an epoch pass before it goes (Retire(), core/lockfree/thread_epoch.h).
/// Threads:     DoAfterCycle() from any; of several threads each does the work after its own cycle.
/// Allocation:  none.
class AfterCycleWork {
 public:
  /// Has the work done when the cycle of the calling thread has ended: once, however often it is asked for. False if
  /// there is no such cycle, or too much is to be done after it (AfterCycleScope::kMost): then it will not be done.
  [[nodiscard]] bool DoAfterCycle() noexcept;
  /// The work itself: outside of the cycle, within its epoch. Those who wait for the cycle's data have been woken.
  virtual void RunAfterCycle() noexcept = 0;

 protected:
  ~AfterCycleWork() = default;
};

/// Opened by executors around a cycle, within an EpochGuard: what is to be done afterwards is done where it ends, in the
/// order in which it was asked for.
class AfterCycleScope {
 public:
  static constexpr std::size_t kMost = 32;

  inline AfterCycleScope() noexcept;
  inline ~AfterCycleScope();
  AfterCycleScope(const AfterCycleScope&) = delete;
  AfterCycleScope& operator=(const AfterCycleScope&) = delete;

 private:
  friend class AfterCycleWork;
  bool Add(AfterCycleWork& work) noexcept;
  [[gnu::cold]] void RunAll() noexcept;

  AfterCycleScope* const outer_;
  std::size_t count_ = 0;
  std::array<AfterCycleWork*, kMost> work_;  // not initialised: cycles that have none do not pay for it
};

namespace internal {
// Of the cycle that the thread is in; nullptr: none.
extern thread_local constinit AfterCycleScope* after_cycle __attribute__((tls_model("initial-exec")));
}  // namespace internal

inline AfterCycleScope::AfterCycleScope() noexcept : outer_(std::exchange(internal::after_cycle, this)) {}
inline AfterCycleScope::~AfterCycleScope() {
  internal::after_cycle = outer_;  // first, so that work finds no cycle
  if (count_ > 0) [[unlikely]]
    RunAll();
}

}  // namespace runnel
