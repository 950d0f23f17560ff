#pragma once

#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/module/module.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"

namespace runnel::test {

class Doubler final : public Module {
 public:
  using Module::Module;
  Input<double> value{this, "value"};
  Output<double> doubled{this, "doubled"};

  Time seen_now{};
  Duration seen_period{};

 private:
  void Update() override {
    seen_now = now();
    seen_period = period();
    if (const auto read = value.Read(); read.is_new()) doubled.Publish(2 * *read);
  }
};

inline std::vector<Task> TasksOf(const FrameworkElement& element) {
  const auto* executable = element.FindAnnotation<Executable>();
  return executable != nullptr ? executable->tasks() : std::vector<Task>{};
}

/// What an executor does with one element in one cycle.
inline void RunOnce(const FrameworkElement& element, const Cycle& cycle = {}) {
  const CycleScope scope(cycle);
  for (const Task& task : TasksOf(element)) task.run();
}

}  // namespace runnel::test
