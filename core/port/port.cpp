#include "core/port/port.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

#include "core/base/exception_text.h"
#include "core/base/retry.h"
#include "core/channel/channel_base.h"
#include "core/conversion/conversion.h"
#include "core/port/connection_rules.h"
#include "core/port/converted_flow.h"
#include "core/port/port_extras.h"
#include "core/port/typed_ports.h"
#include "core/types/type_info.h"

namespace runnel {

thread_local constinit Cycle* internal::current_cycle = nullptr;

namespace {

Error Refusal(const Port& from, std::string message, std::string hint = {}) {
  return {.message = std::move(message), .path = from.path(), .hint = std::move(hint)};
}

bool CanSend(const Port& port) { return port.is_proxy() || port.direction() == Port::Direction::kOutput; }
bool CanReceive(const Port& port) { return port.is_proxy() || port.direction() == Port::Direction::kInput; }

// Looks at the end that has fewer: one output may feed thousands.
bool IsConnected(const Port& from, const Port& to) {
  if (to.incoming().size() < from.outgoing().size()) {
    return std::ranges::find(to.incoming(), &from) != to.incoming().end();
  }
  return from.ConnectionTo(to) != nullptr;
}

// Only interface ports pass data on, so only through them a cycle can close.
bool Reaches(const Port& from, const Port& to) {
  if (&from == &to) return true;
  return std::ranges::any_of(from.outgoing(), [&](const Connection& each) {
    return each.to == &to || (each.to->is_proxy() && Reaches(*each.to, to));
  });
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

// With what would lead from the one to the other.
Error NoConversion(const Port& from, const Port& to, const ConnectOptions& options, const Error& why) {
  Error error = Refusal(from, "carries " + from.type().name() + ", but " + to.path() + " takes " + to.type().name());
  const bool is_plain = options.part.empty() && options.convert.empty();
  if (!is_plain || &from.type() == &to.type()) error.message += ": " + why.message;
  error.hint = why.hint;
  const auto candidates =
      ConversionCandidates({from.type(), to.type(), options.part, options.convert, from.unit(), to.unit()});
  if (!candidates.empty()) error.hint.clear();
  for (ConversionCandidate each : candidates) {
    if (each.part == options.part) each.part.clear();  // said already
    error.hint += (error.hint.empty() ? "what would fit: " : ", or ") + each.text();
  }
  return error;
}

// relaxed: whoever looks has the structure lock, as who sets it.
std::atomic<bool> some_are_late{false};

Error CannotBePulled(const Port& output) {
  return Refusal(output, "cannot be pulled: it has no provider",
                 "its module has to make it pullable and to set a provider");
}

}  // namespace

std::string Connection::SourceText() const { return from->path() + options.PartText(); }

const std::vector<std::string>& OutOfBoundsNames() {
  static const std::vector<std::string> names{"discard", "clamp", "default"};
  return names;
}

Port::Port(const Placement& placement, Direction direction, const TypeInfo& type, std::string description)
    : FrameworkElement(placement, ElementKind::kPort),
      direction_(direction),
      type_(type),
      description_(std::move(description)) {}

Port::~Port() = default;

// From the end: what has been connected last is asked for most.
const Connection* Port::ConnectionTo(const Port& to) const noexcept {
  const auto is_it = [&](const Connection& each) { return each.to == &to; };
  const auto found = std::find_if(outgoing_.rbegin(), outgoing_.rend(), is_it);
  return found == outgoing_.rend() ? nullptr : &*found;
}

ConnectOptions Port::OptionsTo(const Port& to) const {
  const Connection* const edge = ConnectionTo(to);
  return edge != nullptr ? edge->options : ConnectOptions{};
}

bool Port::IsLateTo(const Port& to) const noexcept {
  if (!some_are_late.load(std::memory_order_relaxed)) return false;
  const Connection* const edge = ConnectionTo(to);
  return edge != nullptr && edge->options.late;
}

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
  const auto conversion = internal::ConversionBetween(from, to, options.part, options.convert);
  if (!conversion) return NoConversion(from, to, options, conversion.error());
  if (auto allowed = CheckConnectionRules(from, to); !allowed) return allowed;
  if (options.queue > ConnectOptions::kLongestQueue) {
    return Refusal(
        from, "a queue of " + std::to_string(options.queue) + " values is too long",
        "its memory is taken at once; at most " + std::to_string(ConnectOptions::kLongestQueue) + " values may wait");
  }
  if (!options.pull) return {};
  if (*conversion != nullptr) {
    return Refusal(from, "cannot be pulled through a conversion to " + to.type().name(), "leave out one of the two");
  }
  if (options.queue > 0) {
    return Refusal(from, "a connection that pulls cannot have a queue",
                   "what is pulled is the newest value; leave out one of the two");
  }
  return from.is_pullable() ? Result<void>() : CannotBePulled(from);
}

Result<void> Port::CheckConnection(const Port& from, const Port& to, const ConnectOptions& options) {
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
  const auto conversion = internal::ConversionBetween(from, to, options.part, options.convert);
  if (!conversion) return conversion.error();
  try {
    from.outgoing_.push_back({&from, &to, options});
    from.NoteOutgoing();
    if (*conversion) {
      from.outgoing_.back().converted = std::make_shared<internal::ConvertedFlow>(*conversion, to);
    }
    if (options.late) some_are_late.store(true, std::memory_order_relaxed);
    to.incoming_.push_back(&from);
    to.RebindSinks();
  } catch (...) {  // no memory for the queue
    // Its outputs stay until nobody is bound to them, nor to what was made for them behind it.
    std::shared_ptr<internal::ConvertedFlow> converted;
    if (const Connection* const edge = from.ConnectionTo(to)) converted = edge->converted;
    RemoveEdge(from, to);
    Retry([&] {
      to.RebindSinks();
      to.PruneConversions();
    });
    return Refusal(from, "cannot be connected to " + to.path() + ": " + DescribeException());
  }
  from.runtime().ForEachListener([&](ElementListener& listener) { listener.OnConnected(from, to); });
  return {};
}

bool Port::RemoveEdge(Port& from, Port& to) {
  const Connection* const edge = from.ConnectionTo(to);
  if (edge == nullptr) return false;
  from.outgoing_.erase(from.outgoing_.begin() + (edge - from.outgoing_.data()));
  from.NoteOutgoing();
  std::erase(to.incoming_, &from);
  return true;
}

Result<void> Port::Disconnect(Port& from, Port& to) {
  const std::lock_guard lock(from.runtime().structure_mutex());
  const Connection* const edge = from.ConnectionTo(to);
  if (edge == nullptr) return Refusal(from, "is not connected to " + to.path());
  const auto outgoing_place = edge - from.outgoing_.data();
  const auto incoming_place = std::ranges::find(to.incoming_, &from) - to.incoming_.begin();
  Connection removed = std::move(from.outgoing_[static_cast<std::size_t>(outgoing_place)]);
  RemoveEdge(from, to);
  const auto converted = removed.converted;
  try {
    to.RebindSinks();
    to.PruneConversions();
  } catch (...) {
    // Both lists have the room that it has just left.
    from.outgoing_.insert(from.outgoing_.begin() + outgoing_place, std::move(removed));
    from.NoteOutgoing();
    to.incoming_.insert(to.incoming_.begin() + incoming_place, &from);
    Retry([&] { to.RebindSinks(); });
    return Refusal(from, "cannot be disconnected from " + to.path() + ": " + DescribeException());
  }
  if (converted) converted->KeepOnly({});
  from.runtime().ForEachListener([&](ElementListener& listener) { listener.OnDisconnected(from, to); });
  return {};
}

void Port::DisconnectAll() {
  const std::lock_guard lock(runtime().structure_mutex());
  for (const Setter setter : {Setter::kPerson, Setter::kRule}) {
    if (is_set_by_hand(setter)) Retry([&] { Release(setter); });
  }
  while (!outgoing_.empty()) CutOrWait(*this, *outgoing_.back().to);
  while (!incoming_.empty()) CutOrWait(*incoming_.back(), *this);
}

void Port::Detach() noexcept { DisconnectAll(); }

bool Port::VisitLatest(const Visitor& visit) const {
  const std::lock_guard lock(runtime().structure_mutex());
  return std::ranges::any_of(ValueSources(),
                             [&](const Port* each) { return each != this && each->VisitLatest(visit); });
}

std::uint64_t Port::publications() const noexcept {
  const std::lock_guard lock(runtime().structure_mutex());
  std::uint64_t all = 0;
  for (const Port* each : ValueSources()) {
    if (each != this) all += each->publications();
  }
  return all;
}

Result<PublishStatus> Port::PublishFilled(const Fill&, std::optional<Time>) {
  return CannotPublish(is_proxy() ? "is an interface port" : "is an input");
}

Result<PublishStatus> Port::PublishInto(ChannelBase& channel, const Fill& fill, std::optional<Time> timestamp) {
  if (!channel.can_be_filled()) return CannotPublish("only its module can make values of its type");
  struct Filling {
    const Fill& fill;
    Result<void> filled = {};
  } filling{fill};
  const ValueTimes now = PublicationTimes();
  const auto published = channel.PublishFilled(
      [](void* context, void* value) {
        auto& by = *static_cast<Filling*>(context);
        by.filled = by.fill(value);
        return by.filled.has_value();
      },
      &filling, timestamp ? TimesOf(*timestamp, now.publication_time) : now);
  if (!published) return filling.filled.error();
  if (*published == PublishStatus::kNoBuffer) return CannotPublish("its pool has no free buffer");
  return *published;
}

Error Port::CannotPublish(const char* why) const { return Refusal(*this, std::string("cannot publish: ") + why); }

std::unique_ptr<Port> Port::MakeOutput(FrameworkElement& group, std::string name, OutputOptions options) const {
  const TypedPorts* const ports = FindTypedPorts(type_);
  return ports != nullptr ? ports->MakeOutput(group, std::move(name), std::move(options)) : nullptr;
}

const std::string& Port::unit() const noexcept {
  static const std::string none;
  return none;
}

void Port::Rebind(const std::vector<Source>&) {}

Time Port::TimeOutsideOfCycles() const noexcept { return runtime().clock().Now(); }

Time Port::CoarseTimeOutsideOfCycles(Time timestamp) const noexcept { return runtime().clock().CoarseNow(timestamp); }

}  // namespace runnel
