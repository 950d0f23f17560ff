#include "plugins/structure/module_values.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/base/unit.h"
#include "core/conversion/number_conversion.h"
#include "core/element/attempt.h"
#include "core/element/former_name.h"
#include "core/element/runtime.h"
#include "core/module/group_parameter.h"

namespace runnel::internal {

namespace {

// A number in another unit becomes one in that of the parameter.
std::string TextIn(const std::string& unit, const std::string& value, const Configurable& parameter) {
  const std::string& own = parameter.info().unit;
  return unit != own && RatioOfUnits(unit, own) ? value + " " + unit : value;
}
std::string UnitOfNumber(const Configurable& parameter) {
  return IsNumber(parameter.type()) ? parameter.info().unit : "";
}

using IsTheirTurn = std::function<bool(const FrameworkElement& parameter)>;

// Errors: no such parameter, with the nearest name; a value it refuses.
Result<void> Configure(FrameworkElement& module, const Setting& setting, bool may_be_missing,
                       const IsTheirTurn& is_its_turn) {
  const ConfigurableElement parameter = FindConfigurable(module, setting.parameter);
  if (!parameter) {
    if (may_be_missing) return {};
    const auto name_of = [](const auto& each) { return each.element->name(); };
    return Error{.message = "there is no parameter '" + setting.parameter + "'",
                 .path = module.path(),
                 .hint = NearestNameHint(setting.parameter, NamesOf(ConfigurablesOf(module), name_of))};
  }
  if (!is_its_turn(*parameter.element)) return {};
  const auto set = parameter.configurable->SetFromText(setting.value);
  return set ? set : set.error().WithPath(parameter.element->path());
}

Result<void> CopySettings(const Inherited& inherited, FrameworkElement& after, const IsTheirTurn& is_its_turn) {
  for (const auto& [setting, unit] : inherited) {
    const auto [element, target] = FindConfigurable(after, setting.parameter);
    if (element == nullptr || !is_its_turn(*element)) continue;
    const auto has_its_name = [name = element->name()](const auto& each) { return each.first.parameter == name; };
    if (element->name() != setting.parameter && std::ranges::any_of(inherited, has_its_name)) continue;
    const auto set = target->SetFromText(TextIn(unit, setting.value, *target));
    if (!set) return set.error().WithPath(element->path());
  }
  return {};
}

Result<void> CopyValue(const Configurable& from, Configurable& to) {
  const auto [is_fed, has_been_fed, settings] = from.origin();
  const std::shared_ptr<const void> value = from.Value();
  const bool is_alike = &from.type() == &to.type() && from.info().unit == to.info().unit;
  const auto own = is_alike ? Result(value) : to.Parse(TextIn(UnitOfNumber(from), from.ToText(), to));
  return own ? to.PutBack(own->get(), {is_fed, has_been_fed}) : own.error();
}

std::string PathIn(const FrameworkElement& module, const FrameworkElement& element) {
  return element.path().substr(module.path().size() + 1);
}

template <typename Use>
void ForEachParameter(const FrameworkElement& module, const Use& use) {
  const_cast<FrameworkElement&>(module).VisitAll<FrameworkElement>([&](FrameworkElement& each) {
    auto* const parameter = dynamic_cast<Configurable*>(&each);
    if (parameter != nullptr && dynamic_cast<const GroupParameter*>(&each) == nullptr) use(each, *parameter);
  });
}

// By the parameter of the composite that stands for it, where there is no part like that.
ConfigurableElement CounterpartOf(const FrameworkElement& parameter, const FrameworkElement& before,
                                  const FrameworkElement& after) {
  ConfigurableElement found = ParameterLike(parameter, before, after);
  for (const auto& [element, each] : ConfigurablesOf(before)) {
    const auto* const group = dynamic_cast<const GroupParameter*>(element);
    if (found || group == nullptr) continue;
    const auto targets = group->Find();
    if (std::ranges::count(targets, &parameter, &ConfigurableElement::element) > 0)
      found = ParameterLike(*element, before, after);
  }
  return found;
}

// Whether it has been set since it had been set so often.
bool IsLate(const SettingCounts& counts, const FrameworkElement& module, const FrameworkElement& element,
            const Configurable& parameter) {
  const auto known = counts.find(PathIn(module, element));
  return known == counts.end() || known->second != parameter.origin().settings;
}

}  // namespace

std::vector<Setting> SettingsOf(const FrameworkElement& module) {
  std::vector<Setting> settings;
  for (const auto& [element, parameter] : ConfigurablesOf(module)) {
    std::string value = parameter->ToText();
    if (value != parameter->info().default_value) settings.push_back({element->name(), std::move(value)});
  }
  return settings;
}

Inherited InheritedFrom(const FrameworkElement& module) {
  Inherited inherited;
  for (const Setting& each : SettingsOf(module)) {
    const Configurable& parameter = *FindConfigurable(module, each.parameter).configurable;
    if (!parameter.origin().has_been_fed) inherited.emplace_back(each, UnitOfNumber(parameter));
  }
  return inherited;
}

Result<void> ConfigureNew(FrameworkElement& made, const Inherited& inherited, const std::vector<Setting>& settings) {
  // Construct() goes by these, and may make more.
  std::set<const FrameworkElement*> early;
  for (const auto& [element, parameter] : ConfigurablesOf(made)) {
    if (dynamic_cast<const GroupParameter*>(element) == nullptr) early.insert(element);
  }
  for (const bool is_early : {true, false}) {
    if (!is_early) {
      if (auto constructed = Runtime::Construct(made); !constructed) return constructed;
    }
    const auto is_its_turn = [&](const FrameworkElement& each) { return early.contains(&each) == is_early; };
    if (auto copied = CopySettings(inherited, made, is_its_turn); !copied) return copied;
    for (const Setting& each : settings) {
      if (auto set = Configure(made, each, is_early, is_its_turn); !set) return set;
    }
  }
  return {};
}

ConfigurableElement ParameterLike(const FrameworkElement& parameter, const FrameworkElement& before,
                                  const FrameworkElement& after) {
  if (parameter.parent() != &before && parameter.parent()->parent() != &before) {
    const auto there = after.Find(PathIn(before, parameter));
    auto* const same = there ? dynamic_cast<Configurable*>(*there) : nullptr;
    return same != nullptr ? ConfigurableElement{*there, same} : ConfigurableElement();
  }
  const auto* const former = parameter.FindAnnotation<FormerName>();
  ConfigurableElement found = FindConfigurable(after, parameter.name());
  if (!found && former != nullptr) found = FindConfigurable(after, former->name);
  if (!found || found.element->name() == parameter.name()) return found;
  // There may be one that has more right to it.
  const auto other = FindConfigurable(before, found.element->name());
  return !other || other.element == &parameter ? found : ConfigurableElement();
}

std::set<const Configurable*> NamedBy(const std::vector<Setting>& settings, const FrameworkElement& module) {
  std::set<const Configurable*> named;
  for (const Setting& each : settings) {
    const ConfigurableElement found = FindConfigurable(module, each.parameter);
    named.insert(found.configurable);
    const auto* const group = dynamic_cast<const GroupParameter*>(found.element);
    if (group == nullptr) continue;
    for (const ConfigurableElement& target : group->Find()) named.insert(target.configurable);
  }
  return named;
}

SettingCounts SettingCountsOf(const FrameworkElement& module) {
  SettingCounts counts;
  ForEachParameter(module, [&](const FrameworkElement& element, const Configurable& each) {
    counts[PathIn(module, element)] = each.origin().settings;
  });
  return counts;
}

std::vector<Error> CopyValues(FrameworkElement& before, const SettingCounts& counts, const ReplaceModule& change,
                              const FrameworkElement& after) {
  const std::set<const Configurable*> named = NamedBy(change.settings, after);
  const bool is_way_back = change.state != nullptr;
  std::vector<Error> refused;
  ForEachParameter(before, [&](const FrameworkElement& element, Configurable& each) {
    each.TakeRest();
    const bool has_been_fed = each.origin().has_been_fed;
    if (!has_been_fed && !IsLate(counts, before, element, each)) return;
    const auto [place, target] = CounterpartOf(element, before, after);
    if (place == nullptr || target->info().is_static) return;
    const bool is_named = named.contains(target), is_asked = is_way_back && has_been_fed;
    const Result<void> set = is_named && !is_asked ? Result<void>() : Attempt([&] { return CopyValue(each, *target); });
    if (is_named && is_asked) target->AskFeed();
    if (!set && !each.origin().is_fed) refused.push_back(set.error().WithPath(place->path()));
    // What is known of earlier values is not used at the other one either.
    const bool is_to_be_marked = has_been_fed && !target->origin().has_been_fed;
    if (is_to_be_marked) (void)target->PutBack(target->Value().get(), {false, true});
  });
  return refused;
}

}  // namespace runnel::internal
