#pragma once

#include <cstdint>
#include <vector>

#include "plugins/real_time_check/real_time_watch.h"
#include "plugins/testing/module_rig.h"

namespace runnel::test {

/// Runs so many cycles, and returns what the module has done in them that it should not: allocating, locking, calling
/// the system. Run a few before, in which pools of buffers find their size. Under a sanitizer nothing is noticed.
///
/// The program that uses this has its malloc and its locks replaced, see plugins/real_time_check.
template <typename Rig>
[[nodiscard]] std::vector<RealTimeBreach> RunWatched(Rig& rig, std::uint64_t cycles) {
  struct Watching {
    ~Watching() { rig.SetWatch(nullptr); }
    Rig& rig;
  };
  RealTimeWatch watch(*RunnelRealTimeHooks());
  const Watching until_the_end{rig};
  rig.SetWatch(&watch);
  rig.RunCycles(cycles);
  std::vector<RealTimeBreach> all;
  for (const RealTimeBreaches& of_task : watch.Breaches()) {
    all.insert(all.end(), of_task.breaches.begin(), of_task.breaches.end());
  }
  return all;
}

}  // namespace runnel::test
