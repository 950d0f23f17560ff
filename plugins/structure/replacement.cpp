#include "plugins/structure/replacement.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "core/base/exception_text.h"
#include "core/base/nearest_name.h"
#include "core/base/unit.h"
#include "core/conversion/number_conversion.h"
#include "core/element/former_name.h"
#include "core/element/runtime.h"
#include "core/module/group_parameter.h"
#include "core/module/kept_state.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "core/port/converted_flow.h"
#include "core/port/given_limits.h"
#include "core/port/parameter_input.h"
#include "core/port/port_stop.h"

namespace runnel::internal {

namespace {

bool IsComposite(const FrameworkElement& module) { return module.kind() == ElementKind::kGroup; }

std::optional<Port::ExchangedModules> Composites(const FrameworkElement& before, const FrameworkElement& after) {
  if (!IsComposite(before) && !IsComposite(after)) return {};
  return Port::ExchangedModules{before, after};
}

// What becomes of values on their way, as a file would connect the two.
std::string ConversionText(const Port& from, const Port& to, const ConnectOptions& options) {
  const auto conversion = ConversionBetween(from, to, options.part, options.convert);
  return !conversion ? conversion.error().message : *conversion ? (*conversion)->text() : "";
}

Result<void> CheckConversions(const Port& port, const Port& from, const std::vector<Connection>& edges) {
  for (const auto& [source, to, options, converted] : edges) {
    const bool is_source = source == &from;
    if (ConversionText(*source, *to, options) ==
        ConversionText(is_source ? port : *source, is_source ? *to : port, options))
      continue;
    return Error{.message = "cannot take over from " + from.path() + ": the values between " + source->path() +
                            " and " + to->path() + " would be converted otherwise",
                 .path = port.path(),
                 .hint = "disconnect them first"};
  }
  return {};
}

// Whether the newest value of a source is one from before the release of its block.
bool IsBarred(const Port& port) {
  const auto stop = port.stop();
  return stop && std::ranges::any_of(port.Sources(), [&](const Port* source) {
           bool is_barred = false;
           source->VisitLatest([&](const void*, ValueTimes times) { is_barred = !stop->LetsPass(times); });
           return is_barred;
         });
}

// The element below `after` that is called as `port` is below `before`.
Port* Counterpart(const Port& port, const FrameworkElement& before, FrameworkElement& after) {
  const auto found = after.Find(port.path().substr(before.path().size() + 1));
  if (found) return dynamic_cast<Port*>(*found);
  // A module has its ports in groups, a composite has not.
  if (IsComposite(before) != IsComposite(after) && (!IsComposite(before) || port.parent() == &before)) {
    const bool is_output = port.direction() == Port::Direction::kOutput;
    const auto same = PathSearch(after).FindPort(port.name(), is_output ? PathKind::kOutput : PathKind::kInput);
    if (same) return *same;
  }
  // By which an output sets a parameter: it is made when it is asked for.
  const FrameworkElement* const parameter = ParameterSetBy(port);
  const auto same = parameter != nullptr ? ParameterLike(*parameter, before, after) : ConfigurableElement();
  return same ? same.configurable->Feed() : nullptr;
}

Error NoCounterpart(const Port& port, const FrameworkElement& before, FrameworkElement& after) {
  const auto group = port.parent() == &before ? Result<FrameworkElement*>(&after)
                                              : after.Find(port.parent()->path().substr(before.path().size() + 1));
  return {.message = "the new module has no port '" + port.name() + "', which is connected",
          .path = port.path(),
          .hint = group ? NearestNameHint(port.name(), NamesOf((*group)->children(), &FrameworkElement::name))
                        : "disconnect it first"};
}

// A number in another unit becomes one in that of the parameter.
std::string TextIn(const std::string& unit, const std::string& value, const Configurable& parameter) {
  const std::string& own = parameter.info().unit;
  return unit != own && RatioOfUnits(unit, own) ? value + " " + unit : value;
}
std::string UnitOfNumber(const Configurable& parameter) {
  return IsNumber(parameter.type()) ? parameter.info().unit : "";
}

// Errors: it refuses the value.
Result<void> Give(const Setting& setting, Configurable& parameter) {
  const auto value = parameter.Parse(TextIn(setting.unit, setting.value, parameter));
  return value ? parameter.PutBack(value->get(), setting.was_fed) : value.error();
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
  const auto set = Give(setting, *parameter.configurable);
  return set ? set : set.error().WithPath(parameter.element->path());
}

// What an output had given is left out where it is refused.
Result<void> CopySettings(const std::vector<Setting>& inherited, FrameworkElement& after,
                          const IsTheirTurn& is_its_turn) {
  for (const Setting& each : inherited) {
    const auto [element, target] = FindConfigurable(after, each.parameter);
    if (element == nullptr || !is_its_turn(*element)) continue;
    const bool has_other =
        element->name() != each.parameter && std::ranges::count(inherited, element->name(), &Setting::parameter) > 0;
    if (has_other) continue;
    if (const auto set = Give(each, *target); !set && !each.was_fed) return set.error().WithPath(element->path());
  }
  return {};
}

Result<void> CopyValue(const Configurable& from, Configurable& to) {
  const std::shared_ptr<const void> value = from.Value();
  const bool is_alike = &from.type() == &to.type() && from.info().unit == to.info().unit;
  const auto own = is_alike ? Result(value) : to.Parse(TextIn(UnitOfNumber(from), from.ToText(), to));
  return own ? to.PutBack(own->get(), from.is_fed()) : own.error();
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

}  // namespace

std::vector<Setting> SettingsOf(const FrameworkElement& module) {
  std::vector<Setting> settings;
  for (const auto& [element, parameter] : ConfigurablesOf(module)) {
    std::string value = parameter->ToText();
    if (value == parameter->info().default_value) continue;
    settings.push_back({element->name(), std::move(value), UnitOfNumber(*parameter), parameter->is_fed()});
  }
  return settings;
}

Result<void> ConfigureNew(FrameworkElement& made, const std::vector<Setting>& inherited,
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
    counts[PathIn(module, element)] = each.settings();
  });
  return counts;
}

// Whether it has been set since it had been set so often.
static bool IsLate(const SettingCounts& counts, const FrameworkElement& module, const FrameworkElement& element,
                   const Configurable& parameter) {
  const auto known = counts.find(PathIn(module, element));
  return known == counts.end() || known->second != parameter.settings();
}

std::vector<Error> CopyValues(FrameworkElement& before, const SettingCounts& counts, const ReplaceModule& change,
                              const FrameworkElement& after) {
  const std::set<const Configurable*> named = NamedBy(change.settings, after);
  std::vector<Error> refused;
  const auto copy = [&](const FrameworkElement& element, const Configurable& each) {
    const auto [place, target] = ParameterLike(element, before, after);
    if (place == nullptr || target->info().is_static) return;
    if (named.contains(target) && !(change.counts && each.is_fed() && IsLate(*change.counts, before, element, each)))
      return;
    if (auto set = CopyValue(each, *target); !set && !each.is_fed())
      refused.push_back(set.error().WithPath(place->path()));
  };
  ForEachParameter(before, [](const FrameworkElement&, Configurable& each) { each.TakeRest(); });
  for (const auto& [element, group] : ConfigurablesOf(before)) {
    const auto* const stands = dynamic_cast<const GroupParameter*>(element);
    const auto is_set = [&](const ConfigurableElement& each) {
      return !each.configurable->is_fed() && IsLate(counts, before, *each.element, *each.configurable);
    };
    if (stands != nullptr && std::ranges::any_of(stands->Find(), is_set)) copy(*element, *group);
  }
  ForEachParameter(before, [&](const FrameworkElement& element, const Configurable& each) {
    if (each.is_fed() || IsLate(counts, before, element, each)) copy(element, each);
  });
  return refused;
}

PortMatch MatchPorts(FrameworkElement& before, FrameworkElement& after, const StructureOverlay& overlay) {
  PortMatch result;
  const auto composites = Composites(before, after);
  before.VisitAll<Port>([&](Port& port) {
    Port* match = Counterpart(port, before, after);
    if (std::ranges::count(result.ports, match, &std::pair<Port*, Port*>::second) > 0) match = nullptr;
    auto possible = match != nullptr ? Port::CheckTakeOver(*match, port, composites ? &*composites : nullptr)
                                     : NoCounterpart(port, before, after);
    if (possible) possible = CheckConversions(*match, port, overlay.EdgesOf(port, &before));
    const bool is_held = port.is_blocked() || port.is_set_by_hand() || port.is_set_by_hand(Port::Setter::kRule);
    const bool is_connected = overlay.IsConnected(port, &before);
    const bool is_awaited = !AwaitedWith(overlay.late(), port).empty();
    // What STOP holds, or would once it is connected, is not let go of, unless the other one declares that it moves.
    const bool declares = match != nullptr && match->is_driving() && !match->FindMark();
    const bool moves = port.is_driving() && (is_connected || (!declares && (is_awaited || port.stop()->in_force())));
    const bool is_stopped = match != nullptr && (port.is_blocked() || port.FindMark() || moves);
    // What waits does so for whatever has the name of its port.
    const bool is_missed = is_connected || (is_awaited && match == nullptr);
    if (possible) {
      result.ports.push_back({&port, match});
    } else if (is_stopped || is_missed) {
      // What is worse first.
      result.errors.insert(is_stopped ? result.errors.begin() : result.errors.end(), possible.error());
      if (!is_stopped) result.misfits.emplace_back(&port, match);
    } else if (composites && (is_held || IsBarred(port))) {
      const char* const what = is_held ? "is held" : "waits for a value from after its release";
      result.errors.push_back(
          {.message = std::string("it ") + what + ", and the new module has no such port",
           .path = port.path(),
           .hint = is_held ? "release it first" : "publish one, or delete the module and create the other one"});
    }
  });
  return result;
}

Result<void> CheckMovesAlike(FrameworkElement& before, FrameworkElement& after,
                             const std::vector<std::pair<Port*, Port*>>& ports) {
  if (!Composites(before, after)) return {};
  const auto differs = [](const Port& port) {
    return Error{.message =
                     "something moves by it, and a composite gives its place only to another one in which the same "
                     "moves by ports of the same names",
                 .path = port.path(),
                 .hint = "delete it, and create the other one"};
  };
  std::set<const Port*> moving;  // in both
  for (const auto& [from, to] : ports) {
    if (from->is_driving()) moving.insert({from, to});
  }
  Result<void> alike;
  for (auto* module : {&before, &after}) {
    module->VisitAll<const Port>([&](const Port& port) {
      if (alike && port.is_driving() && !moving.contains(&port)) alike = differs(port);
    });
  }
  if (!alike) return alike;
  const auto leads_to = [](const Port& port, const Port& end) { return std::ranges::count(port.Sinks(), &end) > 0; };
  for (const auto& [from, to] : ports) {
    if (!from->is_proxy() || from->direction() != Port::Direction::kInput) continue;
    for (const auto& [end, its] : ports) {
      if (end->is_driving() && leads_to(*from, *end) != leads_to(*to, *its)) return differs(*from);
    }
  }
  return {};
}

void InheritAnnotations(FrameworkElement& after, const FrameworkElement& before,
                        const std::vector<std::pair<Port*, Port*>>& ports) {
  after.InheritAnnotations(before);
  for (const auto& [from, to] : ports) {
    if (from->is_proxy() == to->is_proxy()) continue;
    const auto* const own = to->FindAnnotation<GivenLimits>();
    auto limits = std::make_unique<GivenLimits>(own != nullptr ? own->limits : InputLimits{});
    to->InheritAnnotations(*from);
    to->Annotate(std::move(limits));
  }
}

void TakeOver(Port& port, Port& from, const FrameworkElement& before, const FrameworkElement& after) {
  const auto composites = Composites(before, after);
  port.TakeOver(from, composites ? &*composites : nullptr);
}

std::vector<Error> StateRefusals(const FrameworkElement& before, const FrameworkElement& after) {
  const auto* const from = before.FindAnnotation<KeptState>();
  const auto* const to = after.FindAnnotation<KeptState>();
  if (from == nullptr || to == nullptr) return {};
  std::vector<Error> refusals = to->Refusals(*from);
  for (Error& each : refusals) each.path = after.path();
  return refusals;
}

Result<void> Settle(const FrameworkElement& module, std::vector<BeforeHandOver::Held>& held) {
  const auto* const first = module.FindAnnotation<BeforeHandOver>();
  if (first == nullptr) return {};
  try {
    held.push_back(first->settle());
    return {};
  } catch (...) {
    return Error{.message = "cannot be replaced now: " + DescribeException(), .path = module.path()};
  }
}

Result<void> CopyState(const FrameworkElement& before, FrameworkElement& after) {
  const auto* const from = before.FindAnnotation<KeptState>();
  auto* const to = after.FindAnnotation<KeptState>();
  if (from == nullptr || to == nullptr) return {};
  try {
    to->TakeOver(*from);
  } catch (...) {
    return Error{.message = "its state could not be handed over: " + DescribeException(), .path = after.path()};
  }
  return {};
}

Result<void> TakeOverFeed(Port& port, const FrameworkElement& before, FrameworkElement& after) {
  Port* const input = ParameterSetBy(port) != nullptr ? Counterpart(port, before, after) : nullptr;
  Result<void> possible = input != nullptr ? Port::CheckTakeOver(*input, port) : NoCounterpart(port, before, after);
  if (possible) TakeOver(*input, port, before, after);
  return possible;
}

}  // namespace runnel::internal
