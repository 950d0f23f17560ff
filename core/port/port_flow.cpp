// Between which ports data flows: Sources(), Sinks(), and what inputs are bound to.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <unordered_set>
#include <utility>

#include "core/conversion/number_conversion.h"
#include "core/port/converted_flow.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/port/proxy_port.h"
#include "core/types/text_format.h"
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

bool IsZero(const AnyValue& value) {
  const std::shared_ptr<const void> zero = value.type().Make();
  return zero != nullptr && value.type().is_transparent() && ToText(value.type(), value.get()) == ToText(value.type(), zero.get());
}

std::optional<double> FindBeginningAt(const Port& input) {
  for (const internal::PassedStop& each : internal::PassedStops(input)) {
    if (each.stop->robot() == nullptr) continue;
    const bool is_number = internal::IsNumber(input.type());
    if (IsVelocity(input.type(), input.unit()) || (IsZero(each.safe_value) && (!is_number || input.unit().empty()))) return NAN;
    const double safe = is_number ? internal::NumberIn(input.type(), each.safe_value.get()) : NAN;
    if (std::isfinite(safe)) return safe;
  }
  std::optional<double> begins_at;
  VisitSiblings(input, Port::Direction::kOutput, [&](const Port& output) {
    if (&output.type() == &input.type() && output.motion_beginnings() != 0) begins_at = output.motion_begins_at();
  });
  return begins_at;
}

// Of two stretches of one way, or two ways from one source, the one that asks for a queue decides;
// of two queues, the longer. If one pulls, all of it does.
ConnectOptions Stronger(const ConnectOptions& a, const ConnectOptions& b) {
  ConnectOptions stronger = b.queue > a.queue ? b : a;
  stronger.pull = a.pull || b.pull;
  return stronger;
}

}  // namespace

void Port::CollectPassedOn(const ConnectOptions& options, Links links,
                           std::vector<Source>& sources) const {
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

void Port::CollectSources(const ConnectOptions& options, Links links,
                          std::vector<Source>& sources) const {
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
  for (Port* sink : Sinks()) {
    sink->Rebind(sink->BoundSources(Links::kMake));
    const auto begins_at = FindBeginningAt(*sink);
    if (!begins_at) continue;
    for (Port* source : sink->Sources()) source->NoteMotion(kFirstBeginning, *begins_at);
  }
}

std::optional<double> internal::FindBeginning(const Port& port) {
  std::optional<double> begins_at;
  for (const Port* sink : port.Sinks()) {
    if (!begins_at) begins_at = FindBeginningAt(*sink);
  }
  return begins_at;
}

bool Port::BeginMotionAnew() {
  static std::atomic<std::uint32_t> last{kFirstBeginning};
  const auto begins_at = internal::FindBeginning(*this);
  if (!begins_at) return false;
  const std::uint32_t beginning = ++last;
  bool is_followed = false;
  for (Port* source : Sources()) is_followed = source->NoteMotion(beginning, *begins_at) || is_followed;
  return is_followed;
}

bool Port::NoteMotion(std::uint32_t beginning, double begins_at) {
  const std::uint32_t known = motion_beginnings();
  const bool is_known = known == beginning || (known != 0 && beginning == kFirstBeginning);
  const double known_at = motion_begins_at();
  if (is_known && (known_at == begins_at || (std::isnan(known_at) && std::isnan(begins_at)))) return false;
  motion_begins_at_.store(begins_at, std::memory_order_relaxed);
  // release: pairs with the acquire in motion_beginnings(): who sees that it begins anew sees where.
  if (!is_known) motion_beginnings_.store(beginning, std::memory_order_release);
  bool is_followed = follows_motion_.load(std::memory_order_relaxed);
  VisitSiblings(*this, Direction::kInput, [&](const Port& input) {
    if (&input.type() != &type()) return;
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

ProxyPort::ProxyPort(const Placement& placement, Direction direction, const TypeInfo& type,
                     std::string description)
    : Port(placement, direction, type, std::move(description)) {}

}  // namespace runnel
