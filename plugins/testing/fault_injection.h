#pragma once

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

namespace runnel::test {

/// What goes wrong at an injected fault.
enum class InjectedFault {
  kAllocation,  ///< operator new throws std::bad_alloc
  kException,   ///< InjectionPoint() throws a std::runtime_error
  kNumber,      ///< InjectionPoint() throws an int
};

inline constexpr InjectedFault kInjectedFaults[] = {InjectedFault::kAllocation, InjectedFault::kException,
                                                    InjectedFault::kNumber};

/// While one lives, the calling thread's n-th allocation, or n-th InjectionPoint(), counted from 1, fails, and so
/// do the `further` ones behind it; those before and after do not.
///
/// The program that links runnel::fault_injection has its operator new replaced, for all libraries in it;
/// sanitizers see through it. Not nested.
/// Threads:  one thread's business; others allocate as ever.
class FaultInjection {
 public:
  FaultInjection(InjectedFault fault, std::size_t nth, std::size_t further = 0) noexcept;
  ~FaultInjection() { End(); }
  FaultInjection(const FaultInjection&) = delete;
  FaultInjection& operator=(const FaultInjection&) = delete;

  /// Nothing fails from now on.
  void End() noexcept;
  /// Whether the n-th has come, and failed.
  [[nodiscard]] bool has_struck() const noexcept;
};

/// Where a test's module, state, or handler may fail: does nothing unless a FaultInjection lives in this
/// thread and this is its call.
void InjectionPoint();

[[nodiscard]] std::string NameOf(InjectedFault fault);

/// Has `operation` meet the fault at the first point where it can come, then at the second, and so on until it
/// gets to its end without one; `further` as for FaultInjection. After each, `check(has_struck)` is called, with no fault any more. Returns at how
/// many points the fault has come. Stops at the first fatal failure.
///
///     AtEachPoint(InjectedFault::kAllocation, [&] { outcome = editor.Apply(changes); },
///                 [&](bool has_struck) { … });
template <typename Operation, typename Check>
std::size_t AtEachPoint(InjectedFault fault, Operation operation, Check check, std::size_t further = 0) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(NameOf(fault) + " " + std::to_string(nth));
    FaultInjection injection(fault, nth, further);
    operation();
    injection.End();
    const bool has_struck = injection.has_struck();
    check(has_struck);
    if (!has_struck || ::testing::Test::HasFatalFailure()) return nth - 1;
  }
}

}  // namespace runnel::test
