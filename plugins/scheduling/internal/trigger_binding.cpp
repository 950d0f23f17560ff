#include "plugins/scheduling/internal/trigger_binding.h"

#include "core/module/wake_source.h"
#include "core/port/input_base.h"

namespace runnel::internal {

void VisitPorts(const FrameworkElement* group, const std::function<void(Port&)>& visit) {
  if (group == nullptr) return;
  for (FrameworkElement* child : group->children()) {
    if (auto* const port = dynamic_cast<Port*>(child)) visit(*port);
    VisitPorts(child, visit);
  }
}

std::vector<InputBase*> TriggerInputs(const std::vector<Task>& tasks) {
  std::vector<InputBase*> inputs;
  for (const Task& task : tasks) {
    for (const FrameworkElement* group : task.reads) {
      VisitPorts(group, [&](Port& port) {
        auto* const input = dynamic_cast<InputBase*>(&port);
        if (input != nullptr && input->is_trigger()) inputs.push_back(input);
      });
    }
  }
  return inputs;
}

// The runner comes last: what is there already is noted with the element alone until a schedule that
// has it is installed.
void BindTriggers(const FrameworkElement& element, const std::vector<InputBase*>& inputs,
                  ScheduledElement& state, CycleRunner* runner) {
  Waker* const waker = runner != nullptr ? &state : nullptr;
  for (InputBase* input : inputs) input->SetWaker(waker);
  if (const auto* const source = element.FindAnnotation<WakeSource>()) source->SetWaker(waker);
  state.set_runner(runner);
}

}  // namespace runnel::internal
