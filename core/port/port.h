#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/channel/subscribers.h"
#include "core/channel/value_times.h"
#include "core/element/framework_element.h"
#include "core/element/runtime.h"
#include "core/port/cycle.h"
#include "core/port/port_options.h"

namespace runnel {

class ChannelBase;
struct HandSlot;
class Port;
class PortStop;
class StopSignal;
class TypeInfo;

namespace internal {
class ConvertedFlow;
struct HeldToLimits;
struct PassedStop;
struct PortExtras;
}  // namespace internal

/// One edge of the data-flow graph, as it was made.
struct Connection {
  Port* from;
  Port* to;
  ConnectOptions options;
  /// What converts the values on their way; nullptr if they pass as they are.
  std::shared_ptr<internal::ConvertedFlow> converted = {};

  /// The path of `from`, with the part of its values that is meant: "/world/pose.x".
  [[nodiscard]] std::string SourceText() const;
};

/// What every port has: a direction, a type, connections. Data flows from outputs to inputs,
/// directly or through the interface ports of groups (ProxyPort), which cost nothing: an input is
/// bound to the outputs at the far end.
///
/// Threads:  connecting and looking at connections under the structure lock (the functions take
///           it); meanwhile others may publish and read.
class Port : public FrameworkElement {
 public:
  enum class Direction { kInput, kOutput };

  ~Port() override;

  [[nodiscard]] Direction direction() const noexcept { return direction_; }
  [[nodiscard]] const TypeInfo& type() const noexcept { return type_; }
  [[nodiscard]] const std::string& description() const noexcept { return description_; }
  /// Of numbers; "" if nobody said.
  [[nodiscard]] virtual const std::string& unit() const noexcept;
  /// An interface port of a group, which only passes on.
  [[nodiscard]] virtual bool is_proxy() const noexcept { return false; }
  [[nodiscard]] virtual bool is_required() const noexcept { return false; }
  /// Outputs: whether it may have a provider. Interface ports: yes, they pass on what is asked of them.
  [[nodiscard]] virtual bool is_pullable() const noexcept { return is_proxy(); }

  /// Outputs: whether it is worth while to publish what nobody but a person wants to see: something is connected, or
  /// somebody has looked since the last call. Who looks again and again, as viewers do, is shown each value. Once a
  /// cycle, by the publisher; wait-free.
  [[nodiscard]] bool is_watched() noexcept {
    // relaxed, all: it only informs.
    return has_outgoing_.load(std::memory_order_relaxed) ||
           (is_looked_at_.load(std::memory_order_relaxed) && is_looked_at_.exchange(false, std::memory_order_relaxed));
  }
  /// Outputs: whether a value was published with a time of measurement that was more than 100 ms to come. Any thread.
  [[nodiscard]] bool stamps_ahead() const noexcept { return stamps_ahead_.load(std::memory_order_relaxed); }
  /// Outputs: 0, unless something that moves the robot is made of it, also by modules that pass it on as a velocity. Then what
  /// is ramped has to begin anew after a STOP, and whenever this number is another one: a block or a value by hand has ended.
  /// Stays so when that port goes. Any thread; wait-free.
  [[nodiscard]] std::uint32_t motion_beginnings() const noexcept {
    return motion_beginnings_.load(std::memory_order_acquire);
  }
  /// The same by a module that does so, in each cycle.
  [[nodiscard]] std::uint32_t FollowMotionBeginnings() noexcept {
    follows_motion_.store(true, std::memory_order_relaxed);
    return motion_beginnings();
  }
  /// Where it begins: NaN is the standstill of a velocity, else it is the safe number of what moves. Any thread; wait-free.
  [[nodiscard]] double motion_begins_at() const noexcept { return motion_begins_at_.load(std::memory_order_relaxed); }
  /// Who looks at the port without being connected to it says so. Any thread.
  void NoteLook() const noexcept { is_looked_at_.store(true, std::memory_order_relaxed); }

  [[nodiscard]] const std::vector<Connection>& outgoing() const noexcept { return outgoing_; }
  [[nodiscard]] const std::vector<Port*>& incoming() const noexcept { return incoming_; }
  /// How this port is connected to `to`, with nothing in between; nullptr: not at all.
  [[nodiscard]] const Connection* ConnectionTo(const Port& to) const noexcept;
  /// Its options, or the usual ones if there is none.
  [[nodiscard]] ConnectOptions OptionsTo(const Port& to) const;
  /// Whether values come one cycle late by it (ConnectOptions::late), so that it does not say which of the two modules
  /// runs first. Quick as long as no connection of the process is late.
  [[nodiscard]] bool IsLateTo(const Port& to) const noexcept;

  /// The ends of the flow through this port: the outputs that feed it (itself, if it is an output
  /// that publishes), and the inputs that it feeds. In the order of connecting.
  [[nodiscard]] std::vector<Port*> Sources() const;
  [[nodiscard]] std::vector<Port*> Sinks() const;
  /// Those whose values readers find here now: what is set by hand, or converted, instead of what it stands
  /// for. Of an input nothing but itself, which shows what it reads.
  [[nodiscard]] std::vector<const Port*> ShownPorts() const;
  /// Outputs: the inputs that are bound to this one's channel: Sinks() but for those that read something else
  /// for now, and what takes values to convert them.
  [[nodiscard]] std::vector<Port*> BoundSinks() const;

  /// Lets data flow between two ports of one runtime. Works while both are in use. Where their types, or
  /// units, differ, or a part of the values is meant, they are converted (conversion.h), in the publisher's
  /// thread, once for all readers behind the connection.
  /// Errors: types that no conversion leads between, wrong directions, a second connection between the same
  /// two, a cycle of interface ports, ports being deleted, options that contradict each other, pulling from
  /// an output that cannot be pulled, a rule that somebody has set up (connection_rules.h); nothing has
  /// changed then.
  static Result<void> Connect(Port& from, Port& to, const ConnectOptions& options = {});
  static Result<void> Disconnect(Port& from, Port& to);
  void DisconnectAll();
  /// What Connect() would say, but for `from` and `to` being connected already or for a cycle.
  [[nodiscard]] static Result<void> CheckEnds(const Port& from, const Port& to, const ConnectOptions& options = {});

  /// Has readers of this port find the value that `fill` writes, in place of whatever else is published, until
  /// Release(); the next time, a new value. Inputs: this one alone; outputs and interface ports: all that
  /// reads from them. Modules publish on, and are not read. It goes over to a module that takes the place of
  /// this port's.
  /// Each setter has a value of its own, and releases no other's: a person's wins over a rule's.
  /// Threads: locks, allocates. Errors: those of `fill`; a type that only its module can make.
  using Fill = std::function<Result<void>(void* value)>;
  enum class Setter { kPerson, kRule };
  /// `timestamp`: of a value that was set before, and is set again.
  Result<void> PublishByHand(const Fill& fill, Setter setter = Setter::kPerson, std::optional<Time> timestamp = {});
  /// Readers find again what is published; if something moves by the port and a person releases, what is published from
  /// now on. False: it was not set by hand.
  bool Release(Setter setter = Setter::kPerson);
  /// Under the structure lock.
  [[nodiscard]] bool is_set_by_hand(Setter setter = Setter::kPerson) const noexcept;
  /// A copy of what is set by hand, with its own timestamp; none if nothing is, or it cannot be copied. Under the structure lock.
  struct HandValue {
    AnyValue value;
    Time timestamp;
    bool is_at_rest = false;  // as nobody is heard of who drives there
  };
  [[nodiscard]] std::optional<HandValue> ValueByHand(Setter setter = Setter::kPerson) const;

  /// That something moves by what is read here: readers find the safe value while the robot is stopped, whatever is
  /// published or set by hand, and after that until a value comes that is stamped and published later than the release.
  /// Inputs: this one; outputs and interface ports: all that reads from them. A module may say so of its inputs
  /// (InputOptions::drives). Stopping takes no lock (RobotStop). It goes over to a port that takes the place of this one.
  /// `safe_value`: of the port's type; without one, the default value of its limits, or zero of a velocity.
  /// Threads: locks, allocates. Errors: there is no safe value; nothing says what kind of command it is; the module says that
  /// something moves by it; it is to brake, and is not made of numbers alone.
  /// `brake`: how long the way from the value read last to the safe one takes (PortStop::brake()); nothing: as its
  /// module declares, or no time. `command`: unspecified: as its module declares, or its units say.
  Result<void> SetDriving(bool drives, AnyValue safe_value = {}, std::optional<Duration> brake = {},
                          DrivingKind command = DrivingKind::kUnspecified);
  /// What SetDriving() is to be told of one like this for it to drive as this does; nothing: its module says it, or it does not.
  /// Under the structure lock, as all that follows.
  [[nodiscard]] std::optional<DrivingMark> FindMark() const;
  /// Stops this port alone, as the robot's STOP would; of ports that do not drive, too.
  /// Errors: there is no safe value. Locks.
  Result<void> Block();
  /// False: it was not blocked. Locks.
  bool Unblock();
  /// All of them under the structure lock.
  [[nodiscard]] bool is_driving() const noexcept;
  [[nodiscard]] bool is_blocked() const noexcept;
  [[nodiscard]] Time blocked_since() const noexcept;  ///< on the machine's steady clock, if it is
  /// For who sends on what is published here: what lets values pass, and the safe value; nullptr: all pass.
  [[nodiscard]] std::shared_ptr<const PortStop> stop() const noexcept;

  /// Inputs: which values it takes from now on, and what its readers find while there is none. Values are
  /// looked at in the publisher's thread, as those that are converted; inputs without limits pay nothing.
  /// Errors: no input; bounds of what is no number; a default of another type, or out of the bounds.
  Result<void> SetLimits(InputLimits limits);
  /// Under the structure lock.
  [[nodiscard]] const InputLimits& limits() const noexcept;
  /// How many values have come that were out of the bounds. Under the structure lock.
  [[nodiscard]] std::uint64_t out_of_bounds() const noexcept;

  struct ExchangedModules {
    const FrameworkElement &before, &after;
  };
  /// Takes the place of `from` in all its connections, without a value being lost, repeated, or seen
  /// anew: an input goes on reading where the other has stopped, an output publishes into the channel
  /// that the readers of the other are bound to. `from` has no connection then; it can take over again.
  /// Preconditions, by CheckTakeOver(): one type and one direction, both or neither interface ports, this
  /// port can be pulled if connections of the other pull, and it is not connected. Nobody reads or publishes through either of them meanwhile;
  /// those at the other ends may. Throws for lack of memory, and has changed nothing then.
  /// `modules`: of which at least one is a composite. What is connected within one stays; the ports may be of other kinds, and
  /// readers get queues anew.
  static Result<void> CheckTakeOver(const Port& port, const Port& from, const ExchangedModules* modules = nullptr);
  void TakeOver(Port& from, const ExchangedModules* modules = nullptr);

  /// Shows the newest value to `visit`, without marking it as read; false if there is none. For
  /// viewers that know the type by its TypeInfo only. Any thread. Ports without values of their own show
  /// that of the first source that has one, under the structure lock.
  using Visitor = std::function<void(const void* value, ValueTimes times)>;
  virtual bool VisitLatest(const Visitor& visit) const;
  /// How many values have passed this port's source, or all its sources together. Any thread; likewise.
  [[nodiscard]] virtual std::uint64_t publications() const noexcept;

  /// Outputs: lends a buffer, has `fill` write the value, and publishes that. `value` is of this
  /// port's type, T{} or what an earlier use has left there. `timestamp`: when it was measured, if that
  /// is known. For who knows the type by its TypeInfo
  /// only. Threads: as Output::Publish(). Errors: those of `fill`, a fixed pool without a free buffer,
  /// a type that only its module can make, a port that is no output; nothing is published then.
  virtual Result<PublishStatus> PublishFilled(const Fill& fill, std::optional<Time> timestamp = {});
  /// Another output for values of the type of this one, which the caller owns; nullptr if only a module
  /// can make such values (no default constructor), and if no module has ports of the type (typed_ports.h).
  /// Throws what the constructor of an element throws.
  [[nodiscard]] std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string name,
                                                 OutputOptions options) const;

 protected:
  Port(const Placement& placement, Direction direction, const TypeInfo& type, std::string description);

  /// What an input is bound to: one output and how the connection to it behaves.
  struct Source {
    Port* output;
    ConnectOptions options;
  };
  /// Inputs: take `sources` for the outputs to read from, from now on.
  virtual void Rebind(const std::vector<Source>& sources);
  /// What two ports of one class have for their connections is exchanged; edges have been already. The second tells who
  /// has to know of it; on the way back all is bound anew instead.
  virtual void ExchangeFlow(Port& /*from*/) noexcept {}
  virtual void FollowExchange(Port& /*from*/) {}
  /// Inputs: `to` stands now where `from` stood.
  virtual void ReplaceSource(const Port& /*from*/, Port& /*to*/) noexcept {}
  /// Binds all inputs at the far end anew.
  void RebindSinks();
  /// Outputs: what is made of it, and of what its module passes on by it, moves; `beginning`: of it. Whether a module follows.
  bool NoteMotion(std::uint32_t beginning, double begins_at);
  /// All that makes what moves by the values that come here begins anew. Nothing where nothing moves by them. Whether a
  /// module follows: what it puts out after this has begun anew.
  bool BeginMotionAnew();
  /// PublishFilled() of ports that have a channel.
  Result<PublishStatus> PublishInto(ChannelBase& channel, const Fill& fill, std::optional<Time> timestamp);
  /// Outputs that publish in the place of somebody else: at which port it goes on.
  [[nodiscard]] virtual const Port* goes_on_at() const noexcept { return nullptr; }
  /// What PublishFilled() says when it cannot.
  [[nodiscard]] Error CannotPublish(const char* why) const;
  /// Outputs: the channel that inputs are bound to; nullptr for other ports.
  [[nodiscard]] virtual ChannelBase* channel() noexcept { return nullptr; }
  /// Gives derived ports access to one another's channel.
  static ChannelBase* ChannelOf(Port& port) noexcept { return port.channel(); }

  /// What the module of this port declares; nullptr: not that something moves by it.
  [[nodiscard]] virtual const PortStop* declared_stop() const noexcept { return nullptr; }
  /// Of this port; `declared`: none, or what somebody has declared.
  [[nodiscard]] Result<AnyValue> FindSafeValue(const AnyValue& declared, DrivingKind command) const;
  [[nodiscard]] Result<DrivingKind> FindDrivingKind(DrivingKind declared, const AnyValue& safe_value) const;
  /// Binds the readers behind it anew. `robot`: nullptr for a port that does not drive.
  Result<void> SetStop(AnyValue safe_value, Duration brake, DrivingKind command, std::shared_ptr<StopSignal> robot);
  internal::PortExtras& Extras();

  /// What a value published now by the calling thread bears: in a cycle, the oldest that its module has read.
  [[nodiscard]] inline ValueTimes PublicationTimes() const noexcept;
  [[nodiscard]] inline Time PublicationTime() const noexcept;
  /// The times of a value that was measured at `timestamp`, for which the clock's coarse time will do outside of cycles.
  [[nodiscard]] inline ValueTimes PublicationTimes(Time timestamp) const noexcept;
  /// The same, published at `now`: what is still to come counts as now.
  [[nodiscard]] inline ValueTimes TimesOf(Time timestamp, Time now) const noexcept;

  void Detach() noexcept override;

 private:
  friend class internal::ConvertedFlow;
  friend struct HandSlot;
  enum class Links { kKeep, kMake };

  [[nodiscard]] Time TimeOutsideOfCycles() const noexcept;
  [[nodiscard]] Time CoarseTimeOutsideOfCycles(Time timestamp) const noexcept;
  [[nodiscard]] Port* by_hand() const noexcept;
  void TellOfChange();
  [[nodiscard]] Result<DrivingMark> Complete(DrivingMark mark, const PortStop* before) const;
  [[nodiscard]] Result<std::shared_ptr<const PortStop>> StopInPlaceOf(const Port& from) const;
  [[nodiscard]] AnyValue FindRest() const;
  void MoveToRest(const AnyValue& before, const AnyValue& now);
  static Result<void> CheckConnection(const Port& from, const Port& to, const ConnectOptions& options);
  /// What this port passes on to who is connected to it: itself, or what it receives.
  void CollectPassedOn(const ConnectOptions& options, Links links, std::vector<Source>& sources) const;
  void CollectSources(const ConnectOptions& options, Links links, std::vector<Source>& sources) const;
  [[nodiscard]] std::vector<Source> BoundSources(Links links) const;
  static void CollectBound(const Port& port, const Port& source, std::vector<Port*>& sinks);
  /// What takes the values of `source` for this input: itself, or what looks whether they are in its limits.
  [[nodiscard]] Port* TakerOf(const Port& source) const;
  void ExchangeLimits(std::unique_ptr<internal::HeldToLimits> limits);
  void HoldToLimits(Links links, std::vector<Source>& sources) const;
  void PruneConversions() const;
  /// Ports without values of their own: whose values they show.
  [[nodiscard]] std::vector<const Port*> ValueSources() const;
  static bool RemoveEdge(Port& from, Port& to);
  void ReserveFor(const Port& from);
  /// `module`: that `from` is in, if what is within it stays.
  void ExchangeConnections(Port& from, const std::vector<Port*>& sinks, const FrameworkElement* module) noexcept;
  void BindAnew(Port& from);

  const Direction direction_;
  const TypeInfo& type_;
  const std::string description_;
  // After each change of `outgoing_`.
  void NoteOutgoing() noexcept { has_outgoing_.store(!outgoing_.empty(), std::memory_order_relaxed); }

  std::vector<Connection> outgoing_;
  std::vector<Port*> incoming_;
  std::atomic<bool> has_outgoing_{false};
  mutable std::atomic<bool> is_looked_at_{false};
  mutable std::atomic<bool> stamps_ahead_{false};
  std::atomic<std::uint32_t> motion_beginnings_{0};
  std::atomic<double> motion_begins_at_{0};
  std::atomic<bool> follows_motion_{false};
  std::unique_ptr<internal::PortExtras> extras_;  // what few ports have
};

inline ValueTimes Port::PublicationTimes() const noexcept {
  const Cycle* cycle = CurrentCycle();
  if (cycle == nullptr) [[unlikely]]
    return ValueTimes::Of(TimeOutsideOfCycles());
  return {cycle->stamp < cycle->now ? cycle->stamp : cycle->now, cycle->now};
}
inline Time Port::PublicationTime() const noexcept {
  const Cycle* cycle = CurrentCycle();
  if (cycle == nullptr) [[unlikely]]
    return TimeOutsideOfCycles();
  return cycle->now;
}
inline ValueTimes Port::PublicationTimes(Time timestamp) const noexcept {
  const Cycle* cycle = CurrentCycle();
  return TimesOf(timestamp, cycle != nullptr ? cycle->now : CoarseTimeOutsideOfCycles(timestamp));
}
inline ValueTimes Port::TimesOf(Time timestamp, Time now) const noexcept {
  if (timestamp <= now && timestamp >= Time(-kFarthest)) [[likely]]
    return {timestamp, now};
  if (timestamp < now) return {Time(-kFarthest), now};
  // A cycle that measures is somewhat ahead of its beginning. relaxed: it only informs.
  constexpr Duration kLongCycle = std::chrono::milliseconds(100);
  if (timestamp - now > kLongCycle) stamps_ahead_.store(true, std::memory_order_relaxed);
  return ValueTimes::Of(now);
}

}  // namespace runnel
