#pragma once

#include <cstdint>
#include <vector>

#include "plugins/genom_modules/views.h"

namespace runnel::genom_modules {

using genom_execution::BoundedText;

struct TaskState {
  BoundedText<32> name;
  std::uint64_t cycles = 0;
  double last = 0, longest = 0, average = 0;  ///< s, in codels, while somebody looks; 0 on a simulated clock
  double load = 0;                            ///< average in a period; 0: has none
};

struct ActivityState {
  std::uint32_t id = 0;
  BoundedText<32> service;
  BoundedText<32> state;
};

/// The port `genom_state` of each component.
struct ComponentState {
  BoundedText<32> component;
  BoundedText<32> version;
  BoundedText<32> digest;
  std::vector<TaskState> tasks;
  std::vector<ActivityState> activities;
};

inline void Describe(TypeBuilder<TaskState>& type) {
  type.Name("genom::task_state")
      .Fields<&TaskState::name, &TaskState::cycles>()
      .Fields<&TaskState::last, &TaskState::longest, &TaskState::average>({.unit = "s"})
      .Field("load", &TaskState::load);
}
inline void Describe(TypeBuilder<ActivityState>& type) {
  type.Name("genom::activity_state").Fields<&ActivityState::id, &ActivityState::service, &ActivityState::state>();
}
inline void Describe(TypeBuilder<ComponentState>& type) {
  type.Name("genom::component_state")
      .Fields<&ComponentState::component, &ComponentState::version, &ComponentState::digest, &ComponentState::tasks,
              &ComponentState::activities>();
}

}  // namespace runnel::genom_modules
