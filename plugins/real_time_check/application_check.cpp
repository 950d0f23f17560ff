#include "plugins/real_time_check/application_check.h"

namespace runnel {

Result<void> ApplicationCheck::Prepare(FrameworkElement& /*application*/,
                                       SchedulerOptions& options) {
  options.watch = watch_.get();
  return {};
}

std::string ApplicationCheck::Finish(Diagnostics& problems) {
  const std::vector<RealTimeBreaches> all = watch_->Breaches();
  for (const RealTimeBreaches& of_module : all) {
    for (const RealTimeBreach& each : of_module.breaches) {
      problems.Add({.message = each.ToString(), .path = of_module.path});
    }
    if (of_module.others == 0) continue;
    problems.Add(
        {.message = "does so at further places, " + std::to_string(of_module.others) + " times",
         .path = of_module.path});
  }
  return all.empty() ? "no module has allocated, locked or called the system in its cycle\n" : "";
}

}  // namespace runnel
