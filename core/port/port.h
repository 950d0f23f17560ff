#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/element/framework_element.h"
#include "core/element/runtime.h"
#include "core/port/cycle.h"
#include "core/port/port_options.h"
#include "core/port/value_times.h"
#include "core/port/waker.h"

namespace runnel {

class ChannelBase;
class Port;
class TypeInfo;

/// One edge of the data-flow graph, as it was made.
struct Connection {
  Port* from;
  Port* to;
  ConnectOptions options;
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
           (is_looked_at_.load(std::memory_order_relaxed) &&
            is_looked_at_.exchange(false, std::memory_order_relaxed));
  }
  /// Who looks at the port without being connected to it says so. Any thread.
  void NoteLook() const noexcept { is_looked_at_.store(true, std::memory_order_relaxed); }

  [[nodiscard]] const std::vector<Connection>& outgoing() const noexcept { return outgoing_; }
  [[nodiscard]] const std::vector<Port*>& incoming() const noexcept { return incoming_; }

  /// The ends of the flow through this port: the outputs that feed it (itself, if it is an output
  /// that publishes), and the inputs that it feeds. In the order of connecting.
  [[nodiscard]] std::vector<Port*> Sources() const;
  [[nodiscard]] std::vector<Port*> Sinks() const;

  /// Lets data flow between two ports of one runtime and one type. Works while both are in use.
  /// Errors: wrong types, wrong directions, a second connection between the same two, a cycle of
  /// interface ports, ports being deleted, options that contradict each other, pulling from an output
  /// that cannot be pulled; nothing has changed then.
  static Result<void> Connect(Port& from, Port& to, const ConnectOptions& options = {});
  static Result<void> Disconnect(Port& from, Port& to);
  void DisconnectAll();
  /// What Connect() would say, but for `from` and `to` being connected already or for a cycle.
  [[nodiscard]] static Result<void> CheckEnds(const Port& from, const Port& to,
                                              const ConnectOptions& options = {});

  /// Takes the place of `from` in all its connections, without a value being lost, repeated, or seen
  /// anew: an input goes on reading where the other has stopped, an output publishes into the channel
  /// that the readers of the other are bound to. `from` has no connection then; it can take over again.
  /// Preconditions, by CheckTakeOver(): one type and one direction, both or neither interface ports, this
  /// port can be pulled if connections of the other pull, and it is not connected. Nobody reads or publishes through either of them meanwhile;
  /// those at the other ends may. Throws for lack of memory, and has changed nothing then.
  static Result<void> CheckTakeOver(const Port& port, const Port& from);
  void TakeOver(Port& from);

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
  using Fill = std::function<Result<void>(void* value)>;
  virtual Result<PublishStatus> PublishFilled(const Fill& fill, std::optional<Time> timestamp = {});
  /// Another output for values of the type of this one, which the caller owns; nullptr if only a module
  /// can make such values (no default constructor), and for ports that know no C++ type: interface ports
  /// and probes. Throws what the constructor of an element throws.
  [[nodiscard]] virtual std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string name,
                                                         OutputOptions options) const;

 protected:
  Port(const Placement& placement, Direction direction, const TypeInfo& type,
       std::string description);

  /// What an input is bound to: one output and how the connection to it behaves.
  struct Source {
    Port* output;
    ConnectOptions options;
  };
  /// Inputs: take `sources` for the outputs to read from, from now on.
  virtual void Rebind(const std::vector<Source>& sources);
  /// What the port has for its connections goes from `from`, of the same class, to this one, and the
  /// other way round. Edges have been exchanged already. If it throws it is called the other way round.
  virtual void TakeOverFlow(Port& /*from*/) {}
  /// Inputs: `to` stands now where `from` stood.
  virtual void ReplaceSource(const Port& /*from*/, Port& /*to*/) noexcept {}
  /// Binds all inputs at the far end anew.
  void RebindSinks();
  /// PublishFilled() of an output: fills `value`, unless it is nullptr for want of a buffer, and has
  /// `publish(*this, loan, times)` publish it.
  Result<PublishStatus> FillAndPublish(void* value, const Fill& fill, std::optional<Time> timestamp,
                                       void* loan,
                                       PublishStatus (*publish)(Port& self, void* loan,
                                                                ValueTimes times));
  /// What PublishFilled() says when it cannot.
  [[nodiscard]] Error CannotPublish(const char* why) const;
  /// Outputs: the channel that inputs are bound to; nullptr for other ports.
  [[nodiscard]] virtual ChannelBase* channel() noexcept { return nullptr; }
  /// Gives derived ports access to one another's channel.
  static ChannelBase* ChannelOf(Port& port) noexcept { return port.channel(); }

  /// The time that a value published now by the calling thread bears.
  [[nodiscard]] inline Time PublicationTime() const noexcept;

  void Detach() noexcept override;

 private:
  [[nodiscard]] Time TimeOutsideOfCycles() const noexcept;
  static Result<void> CheckConnection(const Port& from, const Port& to,
                                      const ConnectOptions& options);
  void CollectSources(const ConnectOptions& options, std::vector<Source>& sources) const;
  static bool RemoveEdge(Port& from, Port& to);
  void ExchangeConnections(Port& from, const std::vector<Port*>& sinks) noexcept;

  const Direction direction_;
  const TypeInfo& type_;
  const std::string description_;
  // After each change of `outgoing_`.
  void NoteOutgoing() noexcept {
    has_outgoing_.store(!outgoing_.empty(), std::memory_order_relaxed);
  }

  std::vector<Connection> outgoing_;
  std::vector<Port*> incoming_;
  std::atomic<bool> has_outgoing_{false};
  mutable std::atomic<bool> is_looked_at_{false};
};

inline Time Port::PublicationTime() const noexcept {
  const Cycle* cycle = CurrentCycle();
  if (cycle == nullptr) [[unlikely]]
    return TimeOutsideOfCycles();
  return cycle->now;
}

}  // namespace runnel
