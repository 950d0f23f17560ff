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
/// count as new. What another runner has been told of and not run yet, this one is told of again.
void Tie(const std::vector<InputBase*>& inputs, ScheduledElement& state, CycleRunner& runner);

/// New data set off nobody any more.
void Untie(const std::vector<InputBase*>& inputs);

}  // namespace runnel::internal
