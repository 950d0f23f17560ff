#include "plugins/scheduling/running_task.h"

#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {

// The element stays while the thread is in its cycle.
const char* RunningModulePath() noexcept {
  const CycleRunner* const runner = CycleRunner::OfThisThread();
  const ScheduledElement* const element = runner != nullptr ? runner->running().element() : nullptr;
  return element != nullptr ? element->path().c_str() : nullptr;
}

}  // namespace runnel
