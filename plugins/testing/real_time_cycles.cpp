#include "plugins/testing/real_time_cycles.h"

namespace runnel::test {

std::vector<RealTimeBreach> RunWatched(ModuleRigBase& rig, std::uint64_t cycles) {
  struct Watching {
    ~Watching() { rig.SetWatch(nullptr); }
    ModuleRigBase& rig;
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
