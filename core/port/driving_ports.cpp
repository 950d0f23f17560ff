#include "core/port/driving_ports.h"

#include <chrono>

#include "core/element/runtime.h"
#include "core/port/parameter_input.h"

namespace runnel {

namespace {

// With the root.
struct DrivingBeside final : Annotation {
  std::vector<std::pair<std::string, std::weak_ptr<const PortStop>>> all;
};

}  // namespace

FrameworkElement* FindModuleOf(const Port& port) {
  FrameworkElement* module = port.parent();
  while (module != nullptr && module->kind() == ElementKind::kPortGroup) module = module->parent();
  return module != nullptr && module->kind() == ElementKind::kModule ? module : nullptr;
}

void VisitSiblings(const Port& port, Port::Direction direction, const std::function<void(Port&)>& visit) {
  FrameworkElement* const module = FindModuleOf(port);
  if (module == nullptr) return;
  module->Visit([&](FrameworkElement& each) {
    auto* const other = dynamic_cast<Port*>(&each);
    if (other == nullptr || other->direction() != direction) return;
    if (ParameterSetBy(*other) == nullptr) visit(*other);
  });
}

Result<void> internal::CheckHasItsPlace(const Port& port) {
  const auto* const state = port.FindAnnotation<DrivingState>();
  if (state == nullptr || !state->is_replaced || state->is_later) return {};
  return Error{.message = "nothing reads what it publishes: a recording that is played has its place",
               .path = port.path(),
               .hint = "end that first"};
}

std::optional<std::string> FindWhatDrives(Runtime& runtime) {
  const auto lock = TryStructureLock(runtime, std::chrono::milliseconds(20));
  if (!lock) return {};
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + name; };
  runtime.root().Visit([&](FrameworkElement& each) {
    const auto* const port = dynamic_cast<const Port*>(&each);
    if (port != nullptr && port->is_driving()) add(port->path());
  });
  if (const auto* const beside = runtime.root().FindAnnotation<DrivingBeside>()) {
    for (const auto& [name, stop] : beside->all) {
      if (!stop.expired()) add(name);
    }
  }
  return names;
}

Error NothingDrives() {
  return {.message = "no port of this application is marked as driving, so STOP stops nothing, and the robot may move",
          .hint = "use its own stop; mark what something moves by: <driving port=\"…\"/>"};
}

void AddWhatDrives(Runtime& runtime, std::string name, const std::shared_ptr<const PortStop>& stop) {
  const std::lock_guard lock(runtime.structure_mutex());
  auto& all = runtime.root().FindOrAnnotate<DrivingBeside>().all;
  std::erase_if(all, [](const auto& each) { return each.second.expired(); });
  all.emplace_back(std::move(name), stop);
}

}  // namespace runnel
