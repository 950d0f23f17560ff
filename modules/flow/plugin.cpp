#include "core/plugin/plugin_entry.h"
#include "modules/flow/passing_module.h"

RUNNEL_PLUGIN(flow, registry) {
  using namespace runnel::flow;
  registry.Add<Mux>("flow/mux", "passes on what comes by one of its inputs");
  registry.Add<Merge>("flow/merge", "passes on what comes by any of its inputs");
  registry.Add<Gate>("flow/gate", "passes values on while it is open");
  registry.Add<Sample>("flow/sample", "passes the newest value on now and then");
  registry.Add<Delay>("flow/delay", "passes values on some time after they came");
}
