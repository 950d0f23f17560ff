#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/base/clock.h"

namespace runnel {

/// A module has thrown in its cycle, and so has failed, or does not return from it.
struct Fault {
  enum class Kind {
    kThrown,
    kStuck,     ///< it has not returned in time, and may still do so
    kReturned,  ///< it has, too late
    kNote,      ///< nothing but what a person should know
  };

  std::string path;         ///< of the module
  std::string message;      ///< what it threw; cut off after kLongestFaultMessage characters
  Time time{};              ///< of the cycle in which it happened
  std::uint64_t cycle = 0;  ///< of its thread, the first is 1; 0 if it is no cycle's fault
  bool is_mended = false;   ///< the scheduler's fault handler has seen to it; no rule is applied
  Kind kind = Kind::kThrown;
};

inline constexpr std::size_t kLongestFaultMessage = 500;

/// What the application does when a module fails (Fault::Kind::kThrown; for others, see StuckRule). Rules are applied in the order of
/// their adding, never in the cycle that failed: after it (simulated clock) or by the supervising
/// thread (real clock).
struct FaultRule {
  std::string of = "/";  ///< path: faults of this element and of all below it
  /// What is called then, which must not call Scheduler::Stop(); what it throws is reported as a fault of `of`.
  /// Without, Scheduler::stop_requested() becomes true.
  std::function<void(const Fault&)> call = {};
  bool ends_run = false;  ///< `call` does that; it becomes true in any case where there is no memory to call
};

}  // namespace runnel
