// Between which ports data flows: Sources(), Sinks(), and what inputs are bound to.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/conversion/number_conversion.h"
#include "core/port/converted_flow.h"
#include "core/port/driving_kind.h"
#include "core/port/driving_ports.h"
#include "core/port/input_base.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/port/proxy_port.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

void CollectSinks(const Port& port, std::vector<Port*>& sinks) {
  for (const Connection& each : port.outgoing()) {
    if (each.to->is_proxy()) {
      CollectSinks(*each.to, sinks);
    } else {
      sinks.push_back(each.to);
    }
  }
}

// Of what is found by `ways`: keeps the first of each. Only through an interface port there are two ways to one.
void DropRepetitions(const std::vector<Connection>& ways, std::vector<Port*>& ports) {
  if (std::ranges::none_of(ways, [](const Connection& each) { return each.to->is_proxy(); })) return;
  std::unordered_set<const Port*> seen;
  std::erase_if(ports, [&](const Port* port) { return !seen.insert(port).second; });
}

// Of what has just been connected: nothing of it has begun anew yet.
constexpr std::uint32_t kFirstBeginning = 1;

// Whether the robot comes to rest by it: when something ends that has held it, it begins from its safe value.
bool ComesToRest(const Port& input, const internal::PassedStop& passed) {
  const PortStop& stop = *passed.stop;
  if (stop.robot() == nullptr || stop.command() == DrivingKind::kPosition) return false;
  // A part of what is marked farther up may be a place beside its velocity: the steering angle of a car.
  const bool is_own = passed.stop == input.stop();
  if (!is_own && DrivingKindByUnits(input.type(), input.unit()) == DrivingKind::kPosition) return false;
  return stop.command() == DrivingKind::kVelocity || (IsZero(passed.safe_value) && IsZero(stop.safe_value()));
}

// Whether what the input reads goes on at `output` as far as it is told: as the module says, or as both are velocities. What is
// measured does not: whoever smooths it would begin at a zero that nobody has measured.
bool IsPassedOn(const Port& from, const Port& output) {
  const auto* const input = dynamic_cast<const InputBase*>(&from);
  const Ageing ageing = input != nullptr ? input->ageing() : Ageing::kUnspecified;
  if (ageing == Ageing::kSetOnce || ageing == Ageing::kWhileSourceRuns) return false;
  const DrivingKind read = DrivingKindByUnits(from.type(), from.unit()),
                    made = DrivingKindByUnits(output.type(), output.unit());
  if (read == DrivingKind::kVelocity && made == DrivingKind::kVelocity) return true;
  return ageing == Ageing::kPassedOn && read != DrivingKind::kPosition && made != DrivingKind::kPosition;
}

// Whether values come from `source` as they are.
bool IsUnchanged(const Port& source, const Port& to) {
  return std::ranges::any_of(to.incoming(), [&](const Port* from) {
    const Connection* const edge = from->ConnectionTo(to);
    return edge != nullptr && !edge->converted && (from == &source || (from->is_proxy() && IsUnchanged(source, *from)));
  });
}

bool IsNotedVelocity(const Port& output) {
  return output.motion_beginnings() != 0 && std::isnan(output.motion_begins_at());
}

// It moves the robot, and comes to a standstill, which is zero, or its module passes it on to what does.
bool IsMadeVelocity(const Port& input) {
  const auto stands = [&](const internal::PassedStop& each) {
    return ComesToRest(input, each) && IsZero(each.safe_value) && IsZero(each.stop->safe_value());
  };
  if (std::ranges::any_of(internal::PassedStops(input), stands)) return true;
  bool is_made = false;
  VisitSiblings(input, Port::Direction::kOutput, [&](const Port& output) {
    is_made = is_made || (IsNotedVelocity(output) && IsPassedOn(input, output));
  });
  return is_made;
}

// The safe value of another number by which the robot moves, such as a position, for who is connected with no module between.
std::optional<double> FindSafeNumber(const Port& source, const Port& input) {
  if (!internal::IsNumber(input.type()) || !IsUnchanged(source, input)) return {};
  for (const internal::PassedStop& each : internal::PassedStops(input)) {
    const double safe = each.stop->robot() != nullptr ? internal::NumberIn(input.type(), each.safe_value.get()) : NAN;
    if (std::isfinite(safe)) return safe;
  }
  return {};
}

// Of two stretches of one way, or two ways from one source, the one that asks for a queue decides;
// of two queues, the longer. If one pulls, all of it does.
ConnectOptions Stronger(const ConnectOptions& a, const ConnectOptions& b) {
  ConnectOptions stronger = b.queue > a.queue ? b : a;
  stronger.pull = a.pull || b.pull;
  return stronger;
}

}  // namespace

void Port::CollectPassedOn(const ConnectOptions& options, Links links, std::vector<Source>& sources) const {
  Port* passed_on = by_hand();
  if (passed_on == nullptr && is_proxy()) return CollectSources(options, links, sources);
  if (passed_on == nullptr) passed_on = const_cast<Port*>(this);
  const auto known = std::ranges::find(sources, passed_on, &Source::output);
  if (known == sources.end()) {
    sources.push_back({passed_on, options});
  } else {
    known->options = Stronger(known->options, options);
  }
}

void Port::CollectSources(const ConnectOptions& options, Links links, std::vector<Source>& sources) const {
  for (Port* from : incoming_) {
    const Connection* const edge = from->ConnectionTo(*this);
    const ConnectOptions stronger = Stronger(options, edge->options);
    if (!edge->converted) {
      from->CollectPassedOn(stronger, links, sources);
      continue;
    }
    std::vector<Source> converted;
    from->CollectPassedOn(stronger, links, converted);
    for (Source& each : converted) {
      each.output = edge->converted->OutputFor(*each.output, links == Links::kMake);
      if (each.output != nullptr) sources.push_back(std::move(each));
    }
  }
}

std::vector<Port::Source> Port::BoundSources(Links links) const {
  std::vector<Source> sources;
  if (Port* const by_hand = this->by_hand()) {
    sources.push_back({by_hand, {}});
    // Its queue stays as long as its connections ask for.
    std::vector<Source> others;
    CollectSources({}, Links::kKeep, others);
    for (const Source& each : others) {
      sources.front().options = Stronger(sources.front().options, each.options);
    }
  } else {
    CollectSources({}, links, sources);
    if (extras_ && extras_->limits) HoldToLimits(links, sources);
  }
  return sources;
}

void Port::RebindSinks() {
  // Of what has moved by it before, and does not any more.
  const std::function<void(Port&)> forget = [&](Port& source) {
    if (!IsNotedVelocity(source) ||
        std::ranges::any_of(source.Sinks(), [](const Port* each) { return IsMadeVelocity(*each); }))
      return;
    source.motion_beginnings_.store(0, std::memory_order_release);
    VisitSiblings(source, Direction::kInput, [&](const Port& input) {
      if (!IsPassedOn(input, source)) return;
      for (Port* each : input.Sources()) forget(*each);
    });
  };
  for (Port* sink : Sinks()) {
    sink->Rebind(sink->BoundSources(Links::kMake));
    const bool is_velocity = IsMadeVelocity(*sink);
    for (Port* source : sink->Sources()) {
      if (!is_velocity) forget(*source);
      const auto begins_at = is_velocity ? std::optional<double>(NAN) : FindSafeNumber(*source, *sink);
      if (begins_at) (void)source->NoteMotion(kFirstBeginning, *begins_at);
    }
  }
}

std::vector<std::shared_ptr<const PortStop>> internal::FindStopsOfVelocities(const Port& port,
                                                                             std::vector<const Port*>& held) {
  std::vector<std::shared_ptr<const PortStop>> found;
  std::unordered_set<const Port*> seen;
  const std::function<void(const Port&)> look = [&](const Port& at) {
    if (!seen.insert(&at).second) return;
    const bool is_held = at.is_set_by_hand(Port::Setter::kPerson) || at.is_set_by_hand(Port::Setter::kRule);
    if (&at != &port && is_held) return held.push_back(&at);
    for (const Connection& each : at.outgoing()) look(*each.to);
    if (at.is_proxy() || at.direction() == Port::Direction::kOutput) return;
    for (PassedStop& each : PassedStops(at)) {
      if (ComesToRest(at, each) && std::ranges::find(found, each.stop) == found.end()) found.push_back(each.stop);
    }
    VisitSiblings(at, Port::Direction::kOutput, [&](const Port& output) {
      if (IsPassedOn(at, output)) look(output);
    });
  };
  look(port);
  return found;
}

bool Port::BeginMotionAnew() {
  static std::atomic<std::uint32_t> last{kFirstBeginning};
  const std::uint32_t beginning = ++last;
  bool is_followed = false;
  for (const Port* sink : Sinks()) {
    const bool is_velocity = IsMadeVelocity(*sink);
    const std::vector<internal::PassedStop> stops = internal::PassedStops(*sink);
    const bool rests =
        is_velocity || std::ranges::any_of(stops, [&](const auto& each) { return ComesToRest(*sink, each); });
    for (Port* source : rests ? Sources() : std::vector<Port*>()) {
      const auto begins_at = is_velocity ? std::optional<double>(NAN) : FindSafeNumber(*source, *sink);
      if (begins_at) is_followed = source->NoteMotion(beginning, *begins_at) || is_followed;
    }
  }
  return is_followed;
}

// A module that passes values on may scale them: only a standstill is the same before it.
bool Port::NoteMotion(std::uint32_t beginning, double begins_at) {
  const std::uint32_t known = motion_beginnings();
  const bool is_velocity = std::isnan(begins_at);
  if (IsNotedVelocity(*this) && (!is_velocity || known == beginning || beginning == kFirstBeginning)) return false;
  motion_begins_at_.store(begins_at, std::memory_order_relaxed);
  // release: pairs with the acquire in motion_beginnings(): who sees that it begins anew sees where.
  if (known != beginning && (known == 0 || beginning != kFirstBeginning))
    motion_beginnings_.store(beginning, std::memory_order_release);
  bool is_followed = follows_motion_.load(std::memory_order_relaxed);
  if (!is_velocity) return is_followed;
  VisitSiblings(*this, Direction::kInput, [&](const Port& input) {
    if (!IsPassedOn(input, *this)) return;
    for (Port* source : input.Sources()) is_followed = source->NoteMotion(beginning, begins_at) || is_followed;
  });
  return is_followed;
}

// Of conversions on the way from here to the inputs, the links of sources that do not reach them any more.
void Port::PruneConversions() const {
  const auto keep = [](internal::ConvertedFlow& flow, const std::vector<Source>& sources) {
    std::vector<Port*> outputs;
    for (const Source& source : sources) outputs.push_back(source.output);
    flow.KeepOnly(outputs);
  };
  if (extras_ && extras_->limits) {
    std::vector<Source> sources;
    if (by_hand() == nullptr) CollectSources({}, Links::kKeep, sources);
    keep(*extras_->limits->flow, sources);
  }
  for (const Connection& each : outgoing_) {
    // Those behind it first: they may take the values of one that goes.
    each.to->PruneConversions();
    if (!each.converted) continue;
    std::vector<Source> sources;
    CollectPassedOn({}, Links::kKeep, sources);
    keep(*each.converted, sources);
  }
}

void Port::CollectBound(const Port& port, const Port& source, std::vector<Port*>& sinks) {
  for (const Connection& each : port.outgoing_) {
    if (each.converted) {
      if (Port* const input = each.converted->InputFor(source)) sinks.push_back(input);
    } else if (each.to->by_hand() != nullptr) {
      continue;
    } else if (each.to->is_proxy()) {
      CollectBound(*each.to, source, sinks);
    } else if (Port* const taker = each.to->TakerOf(source)) {
      sinks.push_back(taker);
    }
  }
}

std::vector<Port*> Port::BoundSinks() const {
  const Port* at = goes_on_at();
  // What is published by hand goes on where it is set, all else only where nothing is.
  const Port* const covers = at == nullptr ? by_hand() : at->by_hand();
  const bool is_covered = covers != nullptr && covers != this;
  if (is_covered) return {};
  if (at == nullptr) at = this;
  if (!at->is_proxy() && at->direction() == Direction::kInput) {
    Port* const taker = at->TakerOf(*this);
    return taker != nullptr ? std::vector<Port*>{taker} : std::vector<Port*>{};
  }
  std::vector<Port*> sinks;
  CollectBound(*at, *this, sinks);
  DropRepetitions(at->outgoing_, sinks);
  return sinks;
}

namespace {

void CollectEnds(const Port& port, std::vector<Port*>& ends) {
  for (Port* from : port.incoming()) {
    if (from->is_proxy()) {
      CollectEnds(*from, ends);
    } else if (std::ranges::find(ends, from) == ends.end()) {
      ends.push_back(from);
    }
  }
}

}  // namespace

std::vector<Port*> Port::Sources() const {
  if (!is_proxy() && direction_ == Direction::kOutput) return {const_cast<Port*>(this)};
  std::vector<Port*> ends;
  CollectEnds(*this, ends);
  return ends;
}

std::vector<const Port*> Port::ShownPorts() const {
  const bool shows_itself = !is_proxy() && direction_ == Direction::kInput;
  return shows_itself ? std::vector<const Port*>{this} : ValueSources();
}

std::vector<const Port*> Port::ValueSources() const {
  std::vector<Source> sources;
  if (is_proxy() || direction_ == Direction::kOutput) {
    CollectPassedOn({}, Links::kKeep, sources);
  } else {
    sources = BoundSources(Links::kKeep);
  }
  std::vector<const Port*> ports;
  for (const Source& each : sources) ports.push_back(each.output);
  return ports;
}

std::vector<Port*> Port::Sinks() const {
  if (!is_proxy() && direction_ == Direction::kInput) return {const_cast<Port*>(this)};
  std::vector<Port*> sinks;
  CollectSinks(*this, sinks);
  DropRepetitions(outgoing_, sinks);
  return sinks;
}

ProxyPort::ProxyPort(const Placement& placement, Direction direction, const TypeInfo& type, std::string description)
    : Port(placement, direction, type, std::move(description)) {}

}  // namespace runnel
