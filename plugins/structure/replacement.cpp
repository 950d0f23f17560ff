#include "plugins/structure/replacement.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/element/runtime.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "core/port/converted_flow.h"
#include "core/port/parameter_input.h"
#include "core/port/port_options.h"
#include "core/port/port_stop.h"
#include "plugins/structure/module_values.h"

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

}  // namespace

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
