#pragma once

#include <optional>

#include <pthread.h>

#include "core/base/error.h"

namespace runnel {

/// Asks the system for what a real-time thread needs. None of it is needed to run: what is not
/// permitted comes back as a warning, and the thread runs all the same, less punctually.

/// Puts `thread` under SCHED_FIFO; with 0 under ordinary scheduling. Precondition: 0 <= priority <= 99.
[[nodiscard]] std::optional<Error> UseScheduling(pthread_t thread, int priority);

/// Keeps the memory of the process from being paged out. Memory that is allocated later is included
/// only where that cannot make allocations fail: without a limit on locked memory.
[[nodiscard]] std::optional<Error> LockMemory();

/// Touches the part of the calling thread's stack that its cycles will use, so that they meet no
/// page that is not there yet. Call at the start of the thread.
void PrefaultStack() noexcept;

}  // namespace runnel
