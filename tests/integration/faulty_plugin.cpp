// A plugin for tests: modules that fail, each in its own way, and some that pull.

#include "core/plugin/plugin_entry.h"
#include "tests/integration/faulty_modules.h"
#include "tests/integration/pulling_modules.h"

RUNNEL_PLUGIN(faulty, registry) {
  using namespace runnel::test;
  registry.Add<FaultyRelay>("faulty/relay", "hands on, and fails after a while");
  registry.Add<FaultyWorker>("faulty/worker", "does nothing, and fails after a while");
  registry.Add<DeafWorker>("faulty/deaf_worker", "has a call that does not come to its end");
  registry.Add<SlowToMake>("faulty/slow_to_make", "is made when there is a file");
  registry.Add<SlowToGo>("faulty/slow_to_go", "goes when there is a file");
  registry.Add<Motor>("faulty/motor", "moves by what it reads");
  registry.Add<FaultyMonitor>("faulty/monitor", "judges the run, and fails at it");
  registry.Add<Counter>("faulty/counter", "counts, a value a cycle");
  registry.Add<Listener>("faulty/listener", "says what it reads first, and after a jump");
  registry.Add<CountingProvider>("faulty/provider", "counts for those who pull");
  registry.Add<CountReader>("faulty/reader", "tells what it reads");
}
