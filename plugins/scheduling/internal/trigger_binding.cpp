#include "plugins/scheduling/internal/trigger_binding.h"

#include "core/port/input.h"
#include "plugins/scheduling/internal/data_flow.h"

namespace runnel::internal {

std::vector<InputBase*> TriggerInputs(const std::vector<Task>& tasks) {
  std::vector<InputBase*> inputs;
  for (const Task& task : tasks) {
    for (const FrameworkElement* group : task.reads) {
      if (group == nullptr) continue;
      VisitPorts(*group, [&](Port& port) {
        auto* const input = dynamic_cast<InputBase*>(&port);
        if (input != nullptr && input->is_trigger()) inputs.push_back(input);
      });
    }
  }
  return inputs;
}

// The runner comes last: what is there already is noted with the element alone until a schedule that
// has it is installed.
void BindTriggers(const std::vector<InputBase*>& inputs, ScheduledElement& state,
                  CycleRunner& runner) {
  for (InputBase* input : inputs) input->SetWaker(&state);
  state.set_runner(&runner);
}

void UnbindTriggers(const std::vector<InputBase*>& inputs) {
  for (InputBase* input : inputs) input->SetWaker(nullptr);
}

}  // namespace runnel::internal
