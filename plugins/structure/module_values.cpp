#include "plugins/structure/module_values.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/attempt.h"
#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/module/group_parameter.h"

namespace runnel::internal {

namespace {

// What waits is taken over. It does not run.
void TakeFeeds(const FrameworkElement& module) {
  const_cast<FrameworkElement&>(module).VisitAll<FrameworkElement>([](FrameworkElement& each) {
    if (auto* const parameter = dynamic_cast<Configurable*>(&each)) parameter->TakeFeed();
  });
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
    return each.path != record.path && !each.is_of_part && is_of_name;
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

// What a parameter stands for in the end, as far as that is in `module`: itself, but for one of a composite.
std::vector<ConfigurableElement> LeavesOf(const ConfigurableElement& parameter, const FrameworkElement& module) {
  const auto* const group = dynamic_cast<const GroupParameter*>(parameter.element);
  if (group == nullptr) {
    const bool is_within = parameter && parameter.element->IsAtOrBelow(module);
    return is_within ? std::vector{parameter} : std::vector<ConfigurableElement>();
  }
  std::vector<ConfigurableElement> leaves;
  for (const ConfigurableElement& target : group->Find()) {
    for (const ConfigurableElement& each : LeavesOf(target, module)) leaves.push_back(each);
  }
  return leaves;
}

// What is set in the module and its parts.
using Named = std::set<const Configurable*>;
bool Contains(const Named& named, const ConfigurableElement& parameter, const FrameworkElement& module) {
  return std::ranges::any_of(LeavesOf(parameter, module),
                             [&](const auto& each) { return named.contains(each.configurable); });
}
void AddTo(Named& named, const ConfigurableElement& parameter, const FrameworkElement& module) {
  for (const ConfigurableElement& each : LeavesOf(parameter, module)) named.insert(each.configurable);
}
Named NamedBy(const std::vector<Setting>& settings, const FrameworkElement& module) {
  Named named;
  for (const Setting& each : settings) AddTo(named, FindConfigurable(module, each.parameter), module);
  return named;
}

// But for what `settings` set.
Result<void> CopySettings(const ParameterRecords& records, const std::vector<Setting>& settings,
                          FrameworkElement& after, const IsTheirTurn& is_its_turn) {
  const Named named = NamedBy(settings, after);
  for (const ParameterRecord& each : records) {
    const ConfigurableElement target = each.is_of_part ? ConfigurableElement() : LikeIn(after, each, records);
    // What stands for others alone is theirs.
    if (LeavesOf(target, after).empty() || !is_its_turn(*target.element) || Contains(named, target, after)) continue;
    const Configurable::Values &own = each.set(),
                               &newest = each.present && each.present->is_fed() ? *each.present : own;
    // What an output has given goes over later, but to what cannot be set any more then.
    const bool is_given = target.configurable->info().is_static && newest.is_fed();
    if (!is_given && !own.own.is_set()) continue;
    const auto put = [&](const Configurable::Values& from, const std::shared_ptr<const void>& value) -> Result<void> {
      const auto good = target.configurable->ConvertedFrom(from, value);
      return good ? target.configurable->Put({*good}) : good.error();
    };
    auto set = is_given ? put(newest, newest.given) : put(own, own.own.value);
    // What has been set or given since and is refused is told when the module has come back.
    const bool is_as_before = !set && each.present;
    if (is_as_before) set = each.values.own.is_set() ? put(each.values, each.values.own.value) : Result<void>();
    if (!set) return set.error().WithPath(target.element->path());
  }
  return {};
}

// `is_as_before`: where it has not been set, nothing is.
Result<void> CopyOwn(const Configurable::Values& from, Configurable& to, bool is_as_before) {
  Configurable::Own own = to.own();
  if (is_as_before && !from.own.is_set() && own.is_set()) {
    const auto value = to.Parse(to.info().default_value);
    if (!value) return value.error();
    own = {*value, 0, own.settings >> Configurable::Own::kSettingsBits << Configurable::Own::kSettingsBits};
  }
  if (!from.own.is_set()) return to.Put({own.value, from.own.given, own.settings});  // each has its default
  const auto value = to.ConvertedFrom(from, from.own.value);
  return value ? to.Put({*value, from.own.given}) : value.error();
}

// Those of `module` that stand for themselves, each with what it is a counterpart of: of several, what stands for fewest.
struct Counterpart {
  ConfigurableElement target;
  const ParameterRecord* record;
  std::size_t width;
};
std::map<std::uint64_t, Counterpart> CounterpartsIn(const FrameworkElement& module, const ParameterRecords& records) {
  std::map<std::uint64_t, Counterpart> all;
  for (const ParameterRecord& each : records) {
    const auto [found, via] = CounterpartIn(module, each, records);
    const bool is_first = via == &each || via->targets.front() == each.path;
    const auto targets = each.is_group || !is_first ? std::vector<ConfigurableElement>() : LeavesOf(found, module);
    for (const ConfigurableElement& target : targets) {
      const Counterpart it{target, &each, targets.size()};
      Counterpart& known = all.try_emplace(target.element->id(), it).first->second;
      if (it.width < known.width) known = it;
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
      if (LeavesOf(found, before).empty()) continue;
      each.present = found.configurable->values();
      if (each.present->number <= via->values.number) each.present->number = 0;
      const bool is_as_left = each.left == found.configurable->OwnText();
      // Or it has been set to just that since an output has given something.
      const bool is_later = each.present->own.given > via->values.own.given;
      each.is_set_since = !each.is_named && each.present->own.is_set() && (!is_as_left || is_later);
    }
    return records;
  }
  ParameterRecords records;
  const auto parameters = ConfigurablesOf(before);
  const_cast<FrameworkElement&>(before).VisitAll<FrameworkElement>([&](FrameworkElement& element) {
    auto* const parameter = dynamic_cast<Configurable*>(&element);
    if (parameter == nullptr) return;
    const auto* const former = element.FindAnnotation<FormerName>();
    const bool is_of_part = std::ranges::count(parameters, &element, &ConfigurableElement::element) == 0;
    records.push_back({.path = PathIn(before, element),
                       .name = element.name(),
                       .former_name = former != nullptr ? former->name : "",
                       .is_of_part = is_of_part,
                       .is_group = dynamic_cast<const GroupParameter*>(&element) != nullptr,
                       .targets = {},
                       .values = parameter->values()});
    if (!records.back().is_group) return;
    for (const ConfigurableElement& each : LeavesOf({&element, parameter}, before)) {
      records.back().targets.push_back(PathIn(before, *each.element));
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
  TakeFeeds(before);
  auto records = std::make_shared<ParameterRecords>(RecordsOf(before));
  Named named = NamedBy(change.settings, after);
  for (const ParameterRecord& each : change.parameters != nullptr ? *change.parameters : ParameterRecords()) {
    if (each.is_named) AddTo(named, LikeIn(after, each, *change.parameters), after);
  }
  for (ParameterRecord& each : *records) {
    each.is_named = Contains(named, CounterpartIn(after, each, *records).first, after);
  }
  return records;
}

void NoteLeft(const GivenParameters& records, const FrameworkElement& after) {
  for (ParameterRecord& each : *std::const_pointer_cast<ParameterRecords>(records)) {
    const ConfigurableElement found = CounterpartIn(after, each, *records).first;
    if (found && found.configurable->own().is_set()) each.left = found.configurable->OwnText();
  }
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

std::vector<Error> CopyValues(const FrameworkElement& before, const ParameterRecords& began,
                              const ReplaceModule* change, const FrameworkElement& after) {
  TakeFeeds(before);
  const Named named = change != nullptr ? NamedBy(change->settings, after) : Named();
  const bool is_way_back = change != nullptr && change->parameters != nullptr;
  const ParameterRecords records = RecordsOf(before, change != nullptr ? change->parameters : nullptr);
  std::vector<Error> refused;
  for (const auto& [id, each] : CounterpartsIn(after, records)) {
    Configurable& target = *each.target.configurable;
    const Configurable::Values &values = each.record->values, &set = each.record->set();
    const Configurable::Values& given = each.record->present ? *each.record->present : values;
    if (target.info().is_static) {
      const Configurable::Values& newest = given.is_fed() ? given : set;
      const auto good = target.ConvertedFrom(newest, newest.is_fed() ? newest.given : newest.own.value);
      if (is_way_back && !good) refused.push_back(good.error().WithPath(each.target.element->path()));
      continue;
    }
    auto taken = target.TakeGiven(values);
    if (auto again = target.TakeGiven(given); taken) taken = std::move(again);
    // What is set anyway needs it not.
    const bool is_needed = given.is_fed() || (is_way_back && !each.record->is_set_since);
    if (named.contains(&target) || !is_needed) taken = {};
    const auto known = std::ranges::find(began, each.record->path, &ParameterRecord::path);
    const bool is_late = known == began.end() || known->values.own.settings != values.own.settings;
    if (named.contains(&target)) {
      (void)target.Put({target.own().value});
    } else if (is_late || (change != nullptr && (is_way_back || values.number + values.refused > 0))) {
      const bool was_set = known != began.end() && known->values.own.is_set();
      auto own = Attempt([&] { return CopyOwn(set, target, is_way_back || was_set); });
      // What had been set before is there, with its number.
      if (!own && each.record->is_set_since) (void)Attempt([&] { return CopyOwn(values, target, true); });
      if (taken) taken = std::move(own);
    }
    if (!taken) refused.push_back(taken.error().WithPath(each.target.element->path()));
  }
  return refused;
}

}  // namespace runnel::internal
