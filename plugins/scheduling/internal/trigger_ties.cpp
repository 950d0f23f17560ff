#include "plugins/scheduling/internal/trigger_ties.h"

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

void Tie(const std::vector<InputBase*>& inputs, ScheduledElement& state, CycleRunner& runner) {
  const bool was_tied = state.runner() != nullptr;
  state.set_runner(&runner);
  bool has_data = false;
  for (InputBase* input : inputs) {
    input->SetWaker(&state);
    has_data = input->LookAtValue([](const void*, Time) {}) || has_data;
  }
  if ((has_data && !was_tied) || state.is_activated()) state.Wake();
}

void Untie(const std::vector<InputBase*>& inputs) {
  for (InputBase* input : inputs) input->SetWaker(nullptr);
}

}  // namespace runnel::internal
