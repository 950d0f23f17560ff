#include <algorithm>

#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

namespace {

// Those that stand in the headers: what codels run in, or yield.
bool IsUsed(const Component& component, const Type& event) {
  if (event.name == "ether" && event.Is(TypeKind::kEvent)) return true;
  return std::ranges::any_of(component.codels(), [&](const Codel* codel) {
    return std::ranges::find(codel->triggers, &event) != codel->triggers.end() ||
           std::ranges::find(codel->yields, &event) != codel->yields.end();
  });
}

// What the headers in C call like that, nullptr if nothing.
const Type* FindInHeaders(const Component& component, std::string_view name) {
  const auto find = [&](const Scope* scope, std::string_view own) -> const Type* {
    if (scope == nullptr) return nullptr;
    const auto found = scope->types.find(own);
    if (found == scope->types.end()) return nullptr;
    const bool is_event = found->second->Is(TypeKind::kEvent) || found->second->Is(TypeKind::kPauseEvent);
    return !is_event || IsUsed(component, *found->second) ? found->second : nullptr;
  };
  if (!name.starts_with(component.name + "_")) return nullptr;
  name.remove_prefix(component.name.size() + 1);
  if (const Type* found = find(component.scope, name)) return found;
  return name.starts_with("pause_") ? find(component.pause_scope, name.substr(6)) : nullptr;
}

}  // namespace

void WarnOfCodelNames(const Component& component, Problems& problems) {
  if (TextOf(component.properties, PropertyKind::kLanguage, "c") != "c") return;
  std::vector<std::string_view> told;
  for (const Codel* codel : component.codels()) {
    const Type* const found = FindInHeaders(component, codel->name);
    if (found == nullptr || std::ranges::find(told, codel->name) != told.end()) continue;
    told.push_back(codel->name);
    problems.Warn(codel->place,
                  "codel '" + codel->name + "' has the name that " + KindAndName(*found) + " has in the headers in C",
                  "codels do not compile with both; give the codel another name");
  }
}

}  // namespace runnel::genom
