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

// But for what `settings` set.
Result<void> CopySettings(const Inherited& inherited, const std::vector<Setting>& settings, FrameworkElement& after,
                          const IsTheirTurn& is_its_turn) {
  const std::set<const Configurable*> named = NamedBy(settings, after);
  for (const InheritedValue& each : inherited) {
    const auto [element, target] = FindConfigurable(after, each.parameter);
    if (element == nullptr || !is_its_turn(*element) || named.contains(target)) continue;
    if (element->name() != each.parameter &&
        std::ranges::count(inherited, element->name(), &InheritedValue::parameter) > 0)
      continue;
    // What an output has given goes over later, but to what cannot be set any more then.
    const std::string& text = target->info().is_static ? each.value : each.own;
    if (text == each.default_value) continue;
    if (const auto set = target->SetFromText(TextIn(each.unit, text, *target)); !set) {
      return set.error().WithPath(element->path());
    }
  }
  return {};
}

Result<void> CopyOwn(const Configurable& from, Configurable& to) {
  const Configurable::Own own = from.own();
  const bool is_alike = &from.type() == &to.type() && from.info().unit == to.info().unit;
  const auto value = is_alike ? Result(own.value) : to.Parse(TextIn(UnitOfNumber(from), from.OwnText(), to));
  return value ? to.Put({*value, own.given}) : value.error();
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

// By the parameter of the composite that stands for it, and for others if this is the first, where there is no part like that.
ConfigurableElement CounterpartOf(const FrameworkElement& parameter, const FrameworkElement& before,
                                  const FrameworkElement& after) {
  ConfigurableElement found = ParameterLike(parameter, before, after);
  for (const auto& [element, each] : ConfigurablesOf(before)) {
    const auto* const group = dynamic_cast<const GroupParameter*>(element);
    const auto targets = !found && group != nullptr ? group->Find() : std::vector<ConfigurableElement>();
    if (!targets.empty() && targets.front().element == &parameter) found = ParameterLike(*element, before, after);
  }
  return found;
}

// Whether it has been set since it had been set so often.
bool IsLate(const SettingCounts& counts, const FrameworkElement& module, const FrameworkElement& element,
            const Configurable& parameter) {
  const auto known = counts.find(PathIn(module, element));
  return known == counts.end() || known->second != parameter.own().settings;
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
  for (const auto& [element, each] : ConfigurablesOf(module)) {
    inherited.push_back(
        {element->name(), each->OwnText(), each->ToText(), each->info().default_value, UnitOfNumber(*each)});
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
    if (auto copied = CopySettings(inherited, settings, made, is_its_turn); !copied) return copied;
    for (const Setting& each : settings) {
      if (auto set = Configure(made, each, is_early, is_its_turn); !set) return set;
    }
  }
  return {};
}

bool IsAlike(const Configurable& from, const Configurable& to) {
  const auto own = to.Parse(TextIn(UnitOfNumber(from), from.OwnText(), to));
  return own && runnel::ToText(to.type(), own->get()) == to.OwnText();
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

SettingCounts NumbersOf(const FrameworkElement& module, std::uint64_t Configurable::Own::*number) {
  SettingCounts numbers;
  ForEachParameter(module, [&](const FrameworkElement& element, const Configurable& each) {
    numbers[PathIn(module, element)] = each.own().*number;
  });
  return numbers;
}

std::vector<Error> CopyValues(FrameworkElement& before, const SettingCounts& counts, const ReplaceModule* change,
                              const FrameworkElement& after) {
  const auto named = change != nullptr ? NamedBy(change->settings, after) : std::set<const Configurable*>();
  const bool is_way_back = change != nullptr && !change->given.empty();
  std::vector<Error> refused;
  ForEachParameter(before, [&](const FrameworkElement& element, Configurable& each) {
    const auto [place, target] = CounterpartOf(element, before, after);
    if (place == nullptr || target->info().is_static) return;
    auto set = target->TakeGiven(each);
    // What is set anyway needs it not; what takes it back, or comes back, has to do without.
    if (named.contains(target) || is_way_back || change == nullptr || !each.is_fed()) set = {};
    const bool has_given = each.is_fed() || each.own().given > 0;
    if (named.contains(target)) {
      Configurable::Own own{target->own().value};
      if (is_way_back) {
        const auto known = change->given.find(PathIn(after, *place));
        own.given = known != change->given.end() ? known->second : each.own().given;
      }
      if (has_given) (void)target->Put(own);
    } else if (set && ((has_given && change != nullptr) || IsLate(counts, before, element, each))) {
      set = Attempt([&] { return CopyOwn(each, *target); });
    }
    if (!set) refused.push_back(set.error().WithPath(place->path()));
  });
  return refused;
}

}  // namespace runnel::internal
