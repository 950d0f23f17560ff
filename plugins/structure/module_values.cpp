#include "plugins/structure/module_values.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <set>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/element/former_name.h"
#include "core/element/runtime.h"
#include "core/module/group_parameter.h"

namespace runnel::internal {

namespace {

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

std::string PathIn(const FrameworkElement& module, const FrameworkElement& element) {
  return element.path().substr(module.path().size() + 1);
}

ConfigurableElement LikeIn(const FrameworkElement& module, const ParameterRecord& record, const ParameterRecords& all) {
  if (record.is_of_part) {
    const auto there = module.Find(record.path);
    auto* const same = there ? dynamic_cast<Configurable*>(*there) : nullptr;
    return same != nullptr ? ConfigurableElement{*there, same} : ConfigurableElement();
  }
  ConfigurableElement found = FindConfigurable(module, record.name);
  if (!found && !record.former_name.empty()) found = FindConfigurable(module, record.former_name);
  if (!found || found.element->name() == record.name) return found;
  // There may be one that has more right to it.
  const bool has_other = std::ranges::any_of(all, [&](const ParameterRecord& each) {
    const bool is_of_name = each.name == found.element->name() || each.former_name == found.element->name();
    return &each != &record && !each.is_of_part && is_of_name;
  });
  return has_other ? ConfigurableElement() : found;
}

// And where there is no part like that, by the parameter of the composite that stands for it: that which stands for fewest.
std::pair<ConfigurableElement, const ParameterRecord*> CounterpartIn(const FrameworkElement& module,
                                                                     const ParameterRecord& record,
                                                                     const ParameterRecords& all) {
  std::pair<ConfigurableElement, const ParameterRecord*> found{LikeIn(module, record, all), &record};
  for (const ParameterRecord& each : all) {
    if (std::ranges::count(each.targets, record.path) == 0) continue;
    if (found.first && (found.second == &record || found.second->targets.size() <= each.targets.size())) continue;
    if (const auto like = LikeIn(module, each, all)) found = {like, &each};
  }
  return found;
}

// The parameters of the module and its parts that settings set.
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

// But for what `settings` set.
Result<void> CopySettings(const ParameterRecords& records, const std::vector<Setting>& settings,
                          FrameworkElement& after, const IsTheirTurn& is_its_turn) {
  const std::set<const Configurable*> named = NamedBy(settings, after);
  for (const ParameterRecord& each : records) {
    const auto [element, target] = each.is_of_part ? ConfigurableElement() : LikeIn(after, each, records);
    if (element == nullptr || !is_its_turn(*element) || named.contains(target)) continue;
    Configurable::Values values = each.set();
    // What an output has given goes over later, but to what cannot be set any more then.
    const bool is_given = target->info().is_static && values.is_fed();
    if (is_given) values.own.value = values.given;
    if (!is_given && !values.own.is_set()) continue;
    const auto value = target->ConvertedFrom(values, values.own.value);
    const auto set = value ? target->Put({*value}) : Result<void>(value.error());
    if (!set) return set.error().WithPath(element->path());
  }
  return {};
}

Result<void> CopyOwn(const Configurable::Values& from, Configurable& to) {
  const Configurable::Own own = to.own();
  if (!from.own.is_set()) return to.Put({own.value, from.own.given, own.settings});  // each has its default
  const auto value = to.ConvertedFrom(from, from.own.value);
  return value ? to.Put({*value, from.own.given}) : value.error();
}

// Those of `module` that stand for themselves, each with what it is a counterpart of: of several, what stands for fewest.
struct Counterpart {
  FrameworkElement* element;
  Configurable* parameter;
  const ParameterRecord* record;
  std::size_t width;
};
std::vector<Counterpart> CounterpartsIn(const FrameworkElement& module, const ParameterRecords& records) {
  std::vector<Counterpart> all;
  for (const ParameterRecord& each : records) {
    const auto [found, via] = CounterpartIn(module, each, records);
    const auto* const group = dynamic_cast<const GroupParameter*>(found.element);
    const bool is_first = via == &each || via->targets.front() == each.path;
    if (!found || !each.targets.empty() || !is_first) continue;
    const auto targets = group != nullptr ? group->Find() : std::vector{found};
    for (const ConfigurableElement& target : targets) {
      const auto known = std::ranges::find(all, target.configurable, &Counterpart::parameter);
      if (known != all.end() && known->width <= targets.size()) continue;
      if (known != all.end()) all.erase(known);
      all.push_back({target.element, target.configurable, &each, targets.size()});
    }
  }
  return all;
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

ParameterRecords RecordsOf(const FrameworkElement& before, const GivenParameters& again) {
  if (again != nullptr) {
    ParameterRecords records = *again;
    for (ParameterRecord& each : records) {
      const auto [found, via] = CounterpartIn(before, each, *again);
      if (!found) continue;
      each.present = found.configurable->values();
      if (each.present->number <= via->values.number) each.present->number = 0;
      const auto value = found.configurable->ConvertedFrom(via->values, via->values.own.value);
      const bool is_alike =
          value && runnel::ToText(found.configurable->type(), value->get()) == found.configurable->OwnText();
      each.is_set_since = !each.is_named && each.present->own.is_set() && !is_alike;
    }
    return records;
  }
  ParameterRecords records;
  const auto parameters = ConfigurablesOf(before);
  const_cast<FrameworkElement&>(before).VisitAll<FrameworkElement>([&](FrameworkElement& element) {
    const auto* const parameter = dynamic_cast<Configurable*>(&element);
    if (parameter == nullptr) return;
    const auto* const former = element.FindAnnotation<FormerName>();
    const bool is_of_part = std::ranges::count(parameters, &element, &ConfigurableElement::element) == 0;
    records.push_back({.path = PathIn(before, element),
                       .name = element.name(),
                       .former_name = former != nullptr ? former->name : "",
                       .is_of_part = is_of_part,
                       .targets = {},
                       .values = parameter->values()});
    const auto* const group = dynamic_cast<const GroupParameter*>(&element);
    if (group == nullptr) return;
    for (const ConfigurableElement& target : group->Find()) {
      if (target.element->IsAtOrBelow(before)) records.back().targets.push_back(PathIn(before, *target.element));
    }
  });
  return records;
}

ConfigurableElement ParameterLike(const FrameworkElement& parameter, const FrameworkElement& before,
                                  const FrameworkElement& after) {
  const ParameterRecords records = RecordsOf(before);
  const auto found = std::ranges::find(records, PathIn(before, parameter), &ParameterRecord::path);
  return found != records.end() ? LikeIn(after, *found, records) : ConfigurableElement();
}

GivenParameters RecordsToComeBack(const FrameworkElement& before, const FrameworkElement& after,
                                  const ReplaceModule& change) {
  auto records = std::make_shared<ParameterRecords>(RecordsOf(before));
  std::set<const Configurable*> named = NamedBy(change.settings, after);
  for (const ParameterRecord& each : change.parameters != nullptr ? *change.parameters : ParameterRecords()) {
    if (each.is_named) named.insert(LikeIn(after, each, *change.parameters).configurable);
  }
  for (ParameterRecord& each : *records) {
    each.is_named = named.contains(CounterpartIn(after, each, *records).first.configurable);
  }
  return records;
}

Result<void> ConfigureNew(FrameworkElement& made, const ParameterRecords& records,
                          const std::vector<Setting>& settings) {
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
    if (auto copied = CopySettings(records, settings, made, is_its_turn); !copied) return copied;
    for (const Setting& each : settings) {
      if (auto set = Configure(made, each, is_early, is_its_turn); !set) return set;
    }
  }
  return {};
}

std::vector<Error> CopyValues(FrameworkElement& before, const ParameterRecords& began, const ReplaceModule* change,
                              const FrameworkElement& after) {
  before.VisitAll<FrameworkElement>([](FrameworkElement& each) {
    if (auto* const parameter = dynamic_cast<Configurable*>(&each)) parameter->TakeFeed();
  });
  const auto named = change != nullptr ? NamedBy(change->settings, after) : std::set<const Configurable*>();
  const bool is_way_back = change != nullptr && change->parameters != nullptr;
  const ParameterRecords records = RecordsOf(before, change != nullptr ? change->parameters : nullptr);
  std::vector<Error> refused;
  for (const Counterpart& each : CounterpartsIn(after, records)) {
    Configurable& target = *each.parameter;
    if (target.info().is_static) continue;
    const Configurable::Values &values = each.record->values, &set = each.record->set();
    const Configurable::Values& given = each.record->present ? *each.record->present : values;
    auto taken = target.TakeGiven(values);
    if (&given != &values) taken = target.TakeGiven(given);
    // What is set anyway needs it not.
    if (named.contains(&target) || !given.is_fed()) taken = {};
    const auto known = std::ranges::find(began, each.record->path, &ParameterRecord::path);
    const bool is_late = known == began.end() || known->values.own.settings != values.own.settings;
    const bool has_given = values.number > 0;
    if (named.contains(&target)) {
      if (has_given) (void)target.Put({target.own().value});
    } else if (taken && (is_late || (change != nullptr && (is_way_back || has_given)))) {
      taken = Attempt([&] { return CopyOwn(set, target); });
    }
    if (!taken) refused.push_back(taken.error().WithPath(each.element->path()));
  }
  return refused;
}

}  // namespace runnel::internal
