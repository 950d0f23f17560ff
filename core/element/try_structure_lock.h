#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

#include "core/element/runtime.h"

namespace runnel {

/// For who can do without the structure lock, and must not wait for long: others have it for a moment again and again, so it
/// is tried for so long. Threads: any that may sleep.
[[nodiscard]] inline std::unique_lock<OrderedMutex> TryStructureLock(Runtime& runtime, Duration patience) {
  std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
  for (const Time latest = SteadyClock().Now() + patience; !lock && SteadyClock().Now() < latest;
       (void)lock.try_lock()) {
    std::this_thread::sleep_for(std::min<Duration>(patience / 10, std::chrono::milliseconds(1)));
  }
  return lock;
}

}  // namespace runnel
