#include "plugins/structure/replacement.h"

#include <algorithm>
#include <string>

#include "core/base/exception_text.h"
#include "core/base/nearest_name.h"
#include "core/element/configurable.h"
#include "core/module/kept_state.h"

namespace runnel::internal {

namespace {

constexpr const char* kParameters = "parameter";

std::vector<std::string> NamesIn(const FrameworkElement& element) {
  std::vector<std::string> names;
  for (const FrameworkElement* each : element.children()) names.push_back(each->name());
  return names;
}

Result<void> Refused(const Result<void>& refusal, const FrameworkElement& parameter) {
  Error error = refusal.error();
  if (error.path.empty()) error.path = parameter.path();
  return error;
}

// The element below `after` that is called as `port` is below `before`.
Port* Counterpart(const Port& port, const FrameworkElement& before, FrameworkElement& after) {
  const auto found = after.Find(port.path().substr(before.path().size() + 1));
  return found ? dynamic_cast<Port*>(*found) : nullptr;
}

Error NoCounterpart(const Port& port, const FrameworkElement& before, FrameworkElement& after) {
  const auto group = after.Find(port.parent()->path().substr(before.path().size() + 1));
  return {.message = "the new module has no port '" + port.name() + "', which is connected",
          .path = port.path(),
          .hint = group ? NearestNameHint(port.name(), NamesIn(**group)) : "disconnect it first"};
}

}  // namespace

Result<void> Configure(FrameworkElement& module, const Setting& setting) {
  const FrameworkElement* const group = module.FindChild(kParameters);
  FrameworkElement* const element = group ? group->FindChild(setting.parameter) : nullptr;
  auto* const parameter = dynamic_cast<Configurable*>(element);
  if (parameter == nullptr) {
    const std::vector<std::string> names = group ? NamesIn(*group) : std::vector<std::string>();
    return Error{.message = "there is no parameter '" + setting.parameter + "'",
                 .path = module.path(),
                 .hint = NearestNameHint(setting.parameter, names)};
  }
  const auto set = parameter->SetFromText(setting.value);
  return set ? set : Refused(set, *element);
}

Result<void> CopySettings(const FrameworkElement& before, FrameworkElement& after) {
  const FrameworkElement* const from = before.FindChild(kParameters);
  FrameworkElement* const to = after.FindChild(kParameters);
  if (from == nullptr || to == nullptr) return {};
  for (FrameworkElement* each : to->children()) {
    const auto* const source = dynamic_cast<const Configurable*>(from->FindChild(each->name()));
    auto* const target = dynamic_cast<Configurable*>(each);
    if (source == nullptr || target == nullptr) continue;
    const std::string value = source->ToText();
    if (value == source->info().default_value) continue;
    if (const auto set = target->SetFromText(value); !set) return Refused(set, *each);
  }
  return {};
}

Values ValuesOf(const FrameworkElement& module) {
  Values values;
  const FrameworkElement* const group = module.FindChild(kParameters);
  if (group == nullptr) return values;
  for (const FrameworkElement* each : group->children()) {
    if (const auto* value = dynamic_cast<const Configurable*>(each)) {
      values[each->name()] = value->ToText();
    }
  }
  return values;
}

Result<void> CopyLateSettings(const FrameworkElement& before, const Values& values,
                              const std::vector<Setting>& settings, FrameworkElement& after) {
  FrameworkElement* const group = after.FindChild(kParameters);
  for (const auto& [name, value] : ValuesOf(before)) {
    const auto known = values.find(name);
    const bool is_set_anyway =
        std::ranges::find(settings, name, &Setting::parameter) != settings.end();
    if (is_set_anyway || (known != values.end() && known->second == value)) continue;
    FrameworkElement* const each = group != nullptr ? group->FindChild(name) : nullptr;
    auto* const target = dynamic_cast<Configurable*>(each);
    if (target == nullptr || target->info().is_static) continue;
    if (const auto set = target->SetFromText(value); !set) return Refused(set, *each);
  }
  return {};
}

PortMatch MatchPorts(FrameworkElement& before, FrameworkElement& after,
                     const std::function<bool(const Port&)>& is_connected) {
  PortMatch result;
  before.Visit([&](FrameworkElement& each) {
    auto* const port = dynamic_cast<Port*>(&each);
    if (port == nullptr) return;
    Port* const match = Counterpart(*port, before, after);
    const auto possible =
        match != nullptr ? Port::CheckTakeOver(*match, *port) : NoCounterpart(*port, before, after);
    if (possible) {
      result.ports.push_back({port, match});
    } else if (is_connected(*port)) {
      result.errors.push_back(possible.error());
    }
  });
  return result;
}

std::vector<Error> StateRefusals(const FrameworkElement& before, const FrameworkElement& after) {
  const auto* const from = before.FindAnnotation<KeptState>();
  const auto* const to = after.FindAnnotation<KeptState>();
  if (from == nullptr || to == nullptr) return {};
  std::vector<Error> refusals = to->Refusals(*from);
  for (Error& each : refusals) each.path = after.path();
  return refusals;
}

Result<void> CopyState(const FrameworkElement& before, FrameworkElement& after) {
  const auto* const from = before.FindAnnotation<KeptState>();
  auto* const to = after.FindAnnotation<KeptState>();
  if (from == nullptr || to == nullptr) return {};
  try {
    to->TakeOver(*from);
  } catch (...) {
    return Error{.message = "its state could not be handed over: " + DescribeException(),
                 .path = after.path()};
  }
  return {};
}

}  // namespace runnel::internal
