#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/channel/subscribers.h"
#include "core/lockfree/event.h"
#include "core/port/port.h"

namespace runnel {

/// What the reader of one input sleeps on until a publisher, or a new connection, brings something.
class ArrivalEvent final : public Waker {
 public:
  void Wake() noexcept override { event_.Notify(); }

  template <typename HasCome>
  [[nodiscard]] bool Wait(KernelFutex::Deadline deadline, HasCome&& has_come) {
    return event_.Wait(deadline, has_come);
  }

 private:
  Event<> event_;
};

/// The part of an input that does not depend on the type of its values.
class InputBase : public Port {
 public:
  [[nodiscard]] bool is_required() const noexcept override { return options_.required; }
  [[nodiscard]] bool is_trigger() const noexcept { return options_.trigger; }
  [[nodiscard]] const std::string& unit() const noexcept override { return options_.unit; }

  ~InputBase() override;

  /// Has `waker` told of new data, and at once of what is there; nullptr for nobody. Locks.
  void SetWaker(Waker* waker);

  /// Sleeps until there is a value that the last Read() has not returned or, if a connection has a
  /// queue, until there is something to Take(); false if there is none when `timeout` has passed (at
  /// once if it is not positive), by the machine's clock. A new connection wakes as a publication
  /// does. In rare cases there may be nothing to Take() after all: a full queue has just dropped it.
  ///
  /// Publishers call the system only if the reader sleeps; for inputs that never wait, they do
  /// nothing at all. Does not pull: it waits for what others publish.
  /// Threads:     the one that reads. It sleeps, so never in a cycle. Nobody may be waiting when the
  ///              input is deleted.
  /// Allocation:  by the first call, which locks too; see InputOptions::waits.
  /// Errors:      throws ProgrammingError in a cycle or inside an EpochGuard, where a thread that
  ///              sleeps would keep all others from deleting anything.
  [[nodiscard]] bool Wait(Duration timeout);

  /// Chooses whether reading pulls (Output::SetProvider()) or takes what has been published. Any
  /// thread, at any time, but not from a cycle: locks and allocates.
  void SetStrategy(Strategy strategy);
  [[nodiscard]] Strategy strategy() const noexcept {
    // relaxed: for viewers; readers are told by a new binding.
    return strategy_.load(std::memory_order_relaxed);
  }
  /// Values lost because the queue was full, since something was connected to the input first, or
  /// first again. Where another connection has changed the queue meanwhile, its drops count on.
  [[nodiscard]] virtual std::uint64_t dropped() const noexcept = 0;
  [[nodiscard]] Ageing ageing() const noexcept { return options_.ageing; }
  /// Whether readers find the safe value because a stop is in force: it is meant, however old it is. Any thread.
  [[nodiscard]] virtual bool is_stop_in_force() const noexcept { return false; }

 protected:
  InputBase(const Placement& placement, const TypeInfo& type, InputOptions options);

  /// What it is bound to. Under the structure lock.
  [[nodiscard]] const std::vector<Source>& sources() const noexcept { return sources_; }
  /// By the constructor of typed inputs, when their type is known. Throws ElementError if there is no safe value.
  void DeclareDriving();
  [[nodiscard]] bool declares_driving() const noexcept { return options_.drives; }
  [[nodiscard]] const PortStop* declared_stop() const noexcept final { return declared_stop_.get(); }

  Result<void> Prepare() override;
  void Rebind(const std::vector<Source>& sources) final;
  void ExchangeFlow(Port& from) noexcept final;
  void FollowExchange(Port& from) final;
  void ReplaceSource(const Port& from, Port& to) noexcept final;
  /// Typed inputs: bind to the channels of `sources`; the queue that publishers shall fill, or
  /// nullptr.
  virtual QueueSink* Bind(const std::vector<Source>& sources) = 0;
  /// Typed inputs: what Bind() has made goes over from `from`, and the other way round.
  virtual void TakeOverBinding(InputBase& from) noexcept = 0;
  /// Typed inputs: Bind() has taken effect everywhere; put first values into a new queue.
  virtual void Bound() = 0;
  /// Typed inputs: whom a stop wakes.
  virtual void TellStops(const Subscribers& /*subscribers*/) {}
  /// Typed inputs: what Wait() waits for. By the reader.
  [[nodiscard]] virtual bool HasNew() const = 0;

 private:
  ArrivalEvent& PrepareToWait();
  [[nodiscard]] bool IsVisited() const noexcept;
  void UpdateChannels();
  void UpdateStops();
  static void UpdateChannel(Port& output);

  const InputOptions options_;
  std::shared_ptr<const PortStop> declared_stop_;
  Waker* waker_ = nullptr;
  QueueSink* sink_ = nullptr;
  std::unique_ptr<ArrivalEvent> arrival_;  // once the reader waits; made by it, under the lock
  std::atomic<Strategy> strategy_;
  std::vector<Source> sources_;
};

}  // namespace runnel
