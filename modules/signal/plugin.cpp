#include "core/plugin/plugin_entry.h"
#include "modules/signal/filters.h"

RUNNEL_PLUGIN(signal, registry) {
  using namespace runnel::signal;
  registry.Add<LowPassFilter>("signal/low_pass", "smooths a number");
  registry.Add<RateLimiterFilter>("signal/rate_limiter", "follows a number no faster than allowed");
  registry.Add<DeadBandFilter>("signal/dead_band", "takes a number near 0 for 0");
  registry.Add<LinearFilter>("signal/linear", "a number times a factor, plus an offset");
}
