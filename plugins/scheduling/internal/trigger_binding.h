#pragma once

#include <functional>
#include <vector>

#include "core/module/executable.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {
class InputBase;
class Port;
}  // namespace runnel

namespace runnel::internal {

/// Calls `visit` for every port below `group`, in the order of their creation; nullptr: for none.
void VisitPorts(const FrameworkElement* group, const std::function<void(Port&)>& visit);

/// Of all that the tasks read, the inputs at which new data set an element off.
[[nodiscard]] std::vector<InputBase*> TriggerInputs(const std::vector<Task>& tasks);

/// New data at `inputs`, and what else sets it off (WakeSource), set off the element, in `runner`'s thread; nullptr: they set off nobody any more.
/// Data that came before it was tied count as new. What has come by then, the runner finds when a
/// schedule with the element is installed.
void BindTriggers(const FrameworkElement& element, const std::vector<InputBase*>& inputs,
                  ScheduledElement& state, CycleRunner* runner);

}  // namespace runnel::internal
