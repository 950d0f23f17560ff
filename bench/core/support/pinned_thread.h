#pragma once

#include <cstddef>

#include <sched.h>

namespace runnel::bench {

/// Keeps the calling thread on one core, the `index`-th of those it may use, as long as this lives.
/// Without that, two threads that talk to each other may land on one core of a busy machine and
/// take turns there: then the scheduler is measured. The first two cores may be two threads of one
/// core: see the README.
class PinnedThread {
 public:
  explicit PinnedThread(std::size_t index) {
    if (sched_getaffinity(0, sizeof(before_), &before_) != 0) return;
    const auto cores = static_cast<std::size_t>(CPU_COUNT(&before_));
    std::size_t left = index % (cores > 0 ? cores : 1);
    for (std::size_t core = 0; core < CPU_SETSIZE; ++core) {
      if (!CPU_ISSET(core, &before_) || left-- > 0) continue;
      cpu_set_t only{};
      CPU_SET(core, &only);
      is_pinned_ = sched_setaffinity(0, sizeof(only), &only) == 0;
      return;
    }
  }
  ~PinnedThread() {
    if (is_pinned_) (void)sched_setaffinity(0, sizeof(before_), &before_);
  }
  PinnedThread(const PinnedThread&) = delete;
  PinnedThread& operator=(const PinnedThread&) = delete;

 private:
  cpu_set_t before_{};
  bool is_pinned_ = false;
};

}  // namespace runnel::bench
