#pragma once

#include <cstddef>

#include "plugins/real_time_check/real_time_hooks.h"

namespace runnel::test {

/// Counts the locks that the calling thread takes, or tries to take, while the probe lives: mutexes
/// and reader-writer locks.
///
/// The program that links this library has these pthread functions replaced, for all libraries in
/// it. Locks inside of the C library itself are not seen.
///
/// Threads:  one probe belongs to one thread and sees only that thread.
/// Under a sanitizer nothing is counted, and works() is false.
class LockProbe {
 public:
  [[nodiscard]] static bool works() noexcept { return RunnelRealTimeHooks()->works; }
  [[nodiscard]] std::size_t locks() const noexcept { return RunnelRealTimeHooks()->counts().locks - before_; }

 private:
  std::size_t before_ = RunnelRealTimeHooks()->counts().locks;
};

}  // namespace runnel::test
