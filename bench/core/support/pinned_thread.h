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
  explicit PinnedThread(std::size_t index) { Pin(index); }
  ~PinnedThread() { (void)sched_setaffinity(0, sizeof(cpu_set_t), &OfTheProcess()); }
  /// For good.
  static void Pin(std::size_t index) {
    const cpu_set_t& all = OfTheProcess();
    const auto cores = static_cast<std::size_t>(CPU_COUNT(&all));
    std::size_t left = index % (cores > 0 ? cores : 1);
    for (std::size_t core = 0; core < CPU_SETSIZE; ++core) {
      if (!CPU_ISSET(core, &all) || left-- > 0) continue;
      cpu_set_t only{};
      CPU_SET(core, &only);
      (void)sched_setaffinity(0, sizeof(only), &only);
      return;
    }
  }

  PinnedThread(const PinnedThread&) = delete;
  PinnedThread& operator=(const PinnedThread&) = delete;

 private:
  // Not the thread's own: that it has from the thread that started it, which may be pinned.
  static const cpu_set_t& OfTheProcess() {
    static const cpu_set_t all = [] {
      cpu_set_t set{};
      (void)sched_getaffinity(0, sizeof(set), &set);
      return set;
    }();
    return all;
  }
};

}  // namespace runnel::bench
