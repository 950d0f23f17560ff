#include "plugins/genom_description/component_rules.h"

#include <algorithm>

namespace runnel::genom {

namespace {

using Source = ParameterSource;

bool IsPrefix(const std::vector<PathStep>& a, const std::vector<PathStep>& b) {
  const std::size_t shared = std::min(a.size(), b.size());
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shared), b.begin());
}

bool Reads(const Parameter& parameter, bool is_of_service) {
  // What goes into a service is written into the ids.
  return parameter.direction == (is_of_service ? Direction::kOut : Direction::kIn);
}

bool Conflict(const Parameter& a, const Parameter& b, bool b_is_of_service = false) {
  if (a.source != b.source) return false;
  if (a.source == Source::kPort) return a.port == b.port;
  if (a.source != Source::kIds || !IsPrefix(a.path, b.path)) return false;
  return !Reads(a, false) || !Reads(b, b_is_of_service);
}

bool Conflict(const std::vector<Parameter>& a, const std::vector<Parameter>& b, bool b_is_of_service = false) {
  return std::ranges::any_of(a, [&](const Parameter& one) {
    return std::ranges::any_of(b, [&](const Parameter& other) { return Conflict(one, other, b_is_of_service); });
  });
}

// Codels of one task never overlap; nor do those of the control task, which have none.
bool CanOverlap(const Codel& codel, const Codel& other) {
  if (codel.task == other.task) return false;
  const bool are_activities = codel.task != nullptr && codel.service != nullptr && other.task != nullptr &&
                              other.service != nullptr;
  // A service starts when what it interrupts has ended.
  return !are_activities || !Interrupts(*other.service, *codel.service);
}

}  // namespace

bool Interrupts(const Service& service, const Service& other) {
  const Property* interrupts = Find(service.properties, PropertyKind::kInterrupts);
  return interrupts != nullptr && std::ranges::any_of(interrupts->texts, [&](const std::string& name) {
           return name == "all" || name == other.name;
         });
}

std::vector<const Codel*> ConflictingCodels(const Codel& codel) {
  std::vector<const Codel*> conflicting;
  for (const Codel* other : codel.component->codels()) {
    if (CanOverlap(codel, *other) && Conflict(codel.parameters, other->parameters)) conflicting.push_back(other);
  }
  return conflicting;
}

std::vector<const Service*> ConflictingServices(const Codel& codel) {
  std::vector<const Service*> conflicting;
  if (codel.task == nullptr) return conflicting;
  for (const Service* service : codel.component->services) {
    if (Conflict(codel.parameters, service->parameters, true)) conflicting.push_back(service);
  }
  return conflicting;
}

std::vector<const Codel*> ConflictingCodels(const Service& service) {
  std::vector<const Codel*> conflicting;
  for (const Codel* codel : service.component->codels()) {
    if (codel->task != nullptr && Conflict(codel->parameters, service.parameters, true)) conflicting.push_back(codel);
  }
  return conflicting;
}

void CheckAsyncCodels(const Component& component, Problems& problems) {
  for (const Codel* codel : component.codels()) {
    if (!codel->is_async) continue;
    const std::string hint = "what it uses is not protected while it runs: copy it in another codel";
    for (const Codel* other : ConflictingCodels(*codel)) {
      // These run before and after all others.
      const bool is_permanent = other->task != nullptr && other->service == nullptr;
      if (is_permanent) {
        const auto start = other->task->states.find("start");
        if (start != other->task->states.end() && start->second == other) continue;
        if (!other->is_reached_from_start) continue;
      }
      problems.Add(codel->place, "async codel '" + codel->name + "' uses what codel '" + other->name + "' uses", hint);
    }
    for (const Service* other : ConflictingServices(*codel)) {
      problems.Add(codel->place, "async codel '" + codel->name + "' uses what attribute '" + other->name + "' uses", hint);
    }
  }
}

}  // namespace runnel::genom
