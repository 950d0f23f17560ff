#include "core/port/port.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <mutex>
#include <thread>
#include <unordered_set>

#include "core/base/check.h"
#include "core/base/exception_text.h"
#include "core/element/runtime.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

Error Refusal(const Port& from, std::string message, std::string hint = {}) {
  return {.message = std::move(message), .path = from.path(), .hint = std::move(hint)};
}

bool CanSend(const Port& port) {
  return port.is_proxy() || port.direction() == Port::Direction::kOutput;
}
bool CanReceive(const Port& port) {
  return port.is_proxy() || port.direction() == Port::Direction::kInput;
}

// Looks at the end that has fewer: one output may feed thousands.
bool IsConnected(const Port& from, const Port& to) {
  if (to.incoming().size() < from.outgoing().size()) {
    return std::ranges::find(to.incoming(), &from) != to.incoming().end();
  }
  return std::ranges::any_of(from.outgoing(),
                             [&](const Connection& each) { return each.to == &to; });
}

// From the end, since what has been connected last is asked for most.
template <typename Connections>
auto FindConnection(Connections& outgoing, const Port& to) {
  const auto found = std::find_if(outgoing.rbegin(), outgoing.rend(),
                                  [&](const Connection& each) { return each.to == &to; });
  return found == outgoing.rend() ? outgoing.end() : std::prev(found.base());
}

// Only interface ports pass data on, so only through them a cycle can close.
bool Reaches(const Port& from, const Port& to) {
  if (&from == &to) return true;
  return std::ranges::any_of(from.outgoing(), [&](const Connection& each) {
    return each.to == &to || (each.to->is_proxy() && Reaches(*each.to, to));
  });
}

void CollectSinks(const Port& port, std::vector<Port*>& sinks) {
  for (const Connection& each : port.outgoing()) {
    if (each.to->is_proxy()) {
      CollectSinks(*each.to, sinks);
    } else {
      sinks.push_back(each.to);
    }
  }
}

// A connection that is to be cut since one end goes must not stay for lack of memory, so it waits until there is
// some.
void CutOrWait(Port& from, Port& to) noexcept {
  try {
    if (Port::Disconnect(from, to)) return;
  } catch (...) {
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// Keeps the first of each.
void DropRepetitions(std::vector<Port*>& ports) {
  std::unordered_set<const Port*> seen;
  std::erase_if(ports, [&](const Port* port) { return !seen.insert(port).second; });
}

// Of two stretches of one way, or two ways from one source, the one that asks for a queue decides;
// of two queues, the longer. If one pulls, all of it does.
ConnectOptions Stronger(const ConnectOptions& a, const ConnectOptions& b) {
  ConnectOptions stronger = b.queue > a.queue ? b : a;
  stronger.pull = a.pull || b.pull;
  return stronger;
}

Error CannotBePulled(const Port& output) {
  return Refusal(output, "cannot be pulled: it has no provider",
                 "its module has to make it pullable and to set a provider");
}

}  // namespace

const std::vector<std::string>& OnFullNames() {
  static const std::vector<std::string> names{"drop_oldest", "drop_newest", "refuse"};
  return names;
}

Port::Port(const Placement& placement, Direction direction, const TypeInfo& type,
           std::string description)
    : FrameworkElement(placement, ElementKind::kPort),
      direction_(direction),
      type_(type),
      description_(std::move(description)) {}

Port::~Port() = default;

Result<void> Port::CheckEnds(const Port& from, const Port& to, const ConnectOptions& options) {
  if (&from.runtime() != &to.runtime()) {
    return Refusal(from, "cannot connect to a port of another runtime");
  }
  for (const Port* port : {&from, &to}) {
    if (port->life_cycle() == LifeCycle::kDeleted) {
      return Refusal(*port, "the port is being deleted and cannot be connected");
    }
  }
  if (&from == &to) return Refusal(from, "a port cannot be connected to itself");
  if (!CanSend(from)) {
    return Refusal(from, "is an input and cannot send",
                   CanSend(to) ? "did you mean to write 'from' and 'to' the other way round?" : "");
  }
  if (!CanReceive(to)) return Refusal(to, "is an output and cannot receive");
  if (&from.type() != &to.type()) {
    return Refusal(from, "carries " + from.type().name() + ", but " + to.path() + " takes " +
                             to.type().name());
  }
  if (!options.pull) return {};
  if (options.queue > 0) {
    return Refusal(from, "a connection that pulls cannot have a queue",
                   "what is pulled is the newest value; leave out one of the two");
  }
  return from.is_pullable() ? Result<void>() : CannotBePulled(from);
}

Result<void> Port::CheckConnection(const Port& from, const Port& to,
                                   const ConnectOptions& options) {
  if (auto ends = CheckEnds(from, to, options); !ends) return ends;
  if (IsConnected(from, to)) return Refusal(from, "is connected to " + to.path() + " already");
  if (from.is_proxy() && to.is_proxy() && Reaches(to, from)) {
    return Refusal(from, "connecting to " + to.path() + " would close a cycle of interface ports");
  }
  return {};
}

Result<void> Port::Connect(Port& from, Port& to, const ConnectOptions& options) {
  const std::lock_guard lock(from.runtime().structure_mutex());
  if (auto possible = CheckConnection(from, to, options); !possible) return possible;
  from.outgoing_.push_back({&from, &to, options});
  from.NoteOutgoing();
  try {
    to.incoming_.push_back(&from);
    to.RebindSinks();
  } catch (...) {  // no memory for the queue
    RemoveEdge(from, to);
    to.RebindSinks();
    return Refusal(from, "cannot be connected to " + to.path() + ": " + DescribeException());
  }
  from.runtime().ForEachListener(
      [&](ElementListener& listener) { listener.OnConnected(from, to); });
  return {};
}

bool Port::RemoveEdge(Port& from, Port& to) {
  const auto connection = FindConnection(from.outgoing_, to);
  if (connection == from.outgoing_.end()) return false;
  from.outgoing_.erase(connection);
  from.NoteOutgoing();
  std::erase(to.incoming_, &from);
  return true;
}

Result<void> Port::Disconnect(Port& from, Port& to) {
  const std::lock_guard lock(from.runtime().structure_mutex());
  const auto edge = FindConnection(from.outgoing_, to);
  if (edge == from.outgoing_.end()) return Refusal(from, "is not connected to " + to.path());
  const auto outgoing_place = edge - from.outgoing_.begin();
  const auto incoming_place = std::ranges::find(to.incoming_, &from) - to.incoming_.begin();
  const Connection removed = *edge;
  RemoveEdge(from, to);
  try {
    to.RebindSinks();
  } catch (...) {
    // Both lists have the room that it has just left.
    from.outgoing_.insert(from.outgoing_.begin() + outgoing_place, removed);
    from.NoteOutgoing();
    to.incoming_.insert(to.incoming_.begin() + incoming_place, &from);
    to.RebindSinks();
    return Refusal(from, "cannot be disconnected from " + to.path() + ": " + DescribeException());
  }
  from.runtime().ForEachListener(
      [&](ElementListener& listener) { listener.OnDisconnected(from, to); });
  return {};
}

Result<void> Port::CheckTakeOver(const Port& port, const Port& from) {
  const auto kind = [](const Port& each) {
    return std::string(each.is_proxy() ? "an interface port" : "") +
           (each.direction() == Direction::kInput ? "an input" : "an output");
  };
  if (kind(port) != kind(from)) {
    return Refusal(port, "cannot take over from " + from.path() + ": one is " + kind(port) +
                             ", the other is " + kind(from));
  }
  if (&port.type() != &from.type()) {
    return Refusal(port, "carries " + port.type().name() + " and cannot take over from " +
                             from.path() + ", which carries " + from.type().name());
  }
  if (!port.incoming_.empty() || !port.outgoing_.empty()) {
    return Refusal(port, "is connected and cannot take over from " + from.path());
  }
  const auto pulls = [](const Connection& each) { return each.options.pull; };
  if (!port.is_pullable() && std::ranges::any_of(from.outgoing_, pulls))
    return CannotBePulled(port);
  return {};
}

void Port::TakeOver(Port& from) {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto possible = CheckTakeOver(*this, from);
  RUNNEL_CHECK(possible, "a port cannot take over from another one");
  const std::vector<Port*> sinks = from.Sinks();
  ExchangeConnections(from, sinks);
  try {
    TakeOverFlow(from);
  } catch (...) {
    // Each as it was, and what has been exchanged by then is exchanged again.
    from.ExchangeConnections(*this, sinks);
    from.TakeOverFlow(*this);
    throw;
  }
}

void Port::ExchangeConnections(Port& from, const std::vector<Port*>& sinks) noexcept {
  for (Connection& each : from.outgoing_) {
    each.from = this;
    std::ranges::replace(each.to->incoming_, &from, this);
  }
  for (Port* port : from.incoming_) {
    for (Connection& each : port->outgoing_) {
      if (each.to == &from) each.to = this;
    }
  }
  outgoing_.swap(from.outgoing_);
  NoteOutgoing();
  from.NoteOutgoing();
  incoming_.swap(from.incoming_);
  for (Port* sink : sinks) {
    if (sink != &from && sink != this) sink->ReplaceSource(from, *this);
  }
}

void Port::DisconnectAll() {
  const std::lock_guard lock(runtime().structure_mutex());
  while (!outgoing_.empty()) CutOrWait(*this, *outgoing_.back().to);
  while (!incoming_.empty()) CutOrWait(*incoming_.back(), *this);
}

void Port::Detach() noexcept { DisconnectAll(); }

void Port::CollectSources(const ConnectOptions& options, std::vector<Source>& sources) const {
  for (Port* from : incoming_) {
    const auto edge = FindConnection(from->outgoing_, *this);
    const ConnectOptions stronger = Stronger(options, edge->options);
    if (from->is_proxy()) {
      from->CollectSources(stronger, sources);
      continue;
    }
    const auto known = std::ranges::find(sources, from, &Source::output);
    if (known == sources.end()) {
      sources.push_back({from, stronger});
    } else {
      known->options = Stronger(known->options, stronger);
    }
  }
}

void Port::RebindSinks() {
  for (Port* sink : Sinks()) {
    std::vector<Source> sources;
    sink->CollectSources({}, sources);
    sink->Rebind(sources);
  }
}

std::vector<Port*> Port::Sources() const {
  if (!is_proxy() && direction_ == Direction::kOutput) return {const_cast<Port*>(this)};
  std::vector<Source> sources;
  CollectSources({}, sources);
  std::vector<Port*> ports;
  for (const Source& source : sources) ports.push_back(source.output);
  return ports;
}

std::vector<Port*> Port::Sinks() const {
  if (!is_proxy() && direction_ == Direction::kInput) return {const_cast<Port*>(this)};
  std::vector<Port*> sinks;
  CollectSinks(*this, sinks);
  const bool has_detours =
      std::ranges::any_of(outgoing_, [](const Connection& each) { return each.to->is_proxy(); });
  if (has_detours) DropRepetitions(sinks);
  return sinks;
}

bool Port::VisitLatest(const Visitor& visit) const {
  const std::lock_guard lock(runtime().structure_mutex());
  return std::ranges::any_of(Sources(), [&](Port* source) { return source->VisitLatest(visit); });
}

std::uint64_t Port::publications() const noexcept {
  const std::lock_guard lock(runtime().structure_mutex());
  std::uint64_t all = 0;
  for (const Port* source : Sources()) all += source->publications();
  return all;
}

Result<PublishStatus> Port::PublishFilled(const Fill&, std::optional<Time>) {
  return CannotPublish(is_proxy() ? "is an interface port" : "is an input");
}

Result<PublishStatus> Port::FillAndPublish(void* value, const Fill& fill,
                                           std::optional<Time> timestamp, void* loan,
                                           PublishStatus (*publish)(Port& self, void* loan,
                                                                    ValueTimes times)) {
  if (value == nullptr) return CannotPublish("its pool has no free buffer");
  if (auto filled = fill(value); !filled) return filled.error();
  const Time now = PublicationTime();
  return publish(*this, loan, {timestamp.value_or(now), now});
}

Error Port::CannotPublish(const char* why) const {
  return Refusal(*this, std::string("cannot publish: ") + why);
}

std::unique_ptr<Port> Port::MakeOutput(FrameworkElement&, std::string, OutputOptions) const {
  return nullptr;
}

void Port::Rebind(const std::vector<Source>&) {}

Time Port::TimeOutsideOfCycles() const noexcept { return runtime().clock().Now(); }

}  // namespace runnel
