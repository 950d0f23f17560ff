#pragma once

#include <vector>

#include "core/module/executable.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {
class InputBase;
}

namespace runnel::internal {

/// Of all that the tasks read, the inputs at which new data set an element off.
[[nodiscard]] std::vector<InputBase*> TriggerInputs(const std::vector<Task>& tasks);

/// New data at `inputs` set off the element, in `runner`'s thread. Data that came before it was tied
/// count as new. What has come by then, the runner finds when a schedule with the element is installed.
void BindTriggers(const std::vector<InputBase*>& inputs, ScheduledElement& state,
                  CycleRunner& runner);

/// New data set off nobody any more.
void UnbindTriggers(const std::vector<InputBase*>& inputs);

}  // namespace runnel::internal
