#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "core/base/clock.h"
#include "core/channel/channel_base.h"
#include "core/port/input_binding.h"
#include "core/port/port_stop.h"

namespace runnel {
class Runtime;
}

namespace runnel::internal {

/// What an input is bound to besides its sources: a stop, with a channel that has the safe value as its newest. A press
/// publishes it anew, so that whoever waits is woken, and finds it once as new.
///
/// A port that brakes (PortStop::brake()): whoever reads finds a value on the way from the one that was read last to
/// the safe one. It is worked out when it is read, so it comes from nobody's thread. The way begins at the press, once
/// for each time that something else has been read. Who is woken by values, or takes them from a queue, finds the safe
/// value at once: nobody would wake him for the next one.
///
/// Threads:  made and ended under the structure lock; a press publishes in its own thread, with neither that lock nor
///           a cycle.
class StopLink {
 public:
  /// `channel`: empty, of the input's type. Throws if the value cannot be copied.
  StopLink(PassedStop stop, std::unique_ptr<ChannelBase> channel, const Runtime& runtime);
  ~StopLink();
  StopLink(const StopLink&) = delete;
  StopLink& operator=(const StopLink&) = delete;

  /// Whether it is that stop, with the same safe value: one that was converted is another object each time.
  [[nodiscard]] bool Is(const PassedStop& stop) const;
  [[nodiscard]] const PortStop& stop() const noexcept { return *stop_.stop; }
  [[nodiscard]] ChannelBase& channel() const noexcept { return *channel_; }
  [[nodiscard]] InputLink& link() noexcept { return link_; }
  /// Whether there are values between it and others that come through `channel`: all that it is made of is numbers.
  [[nodiscard]] static bool CanBrake(const AnyValue& safe_value, const ChannelBase& channel);
  [[nodiscard]] bool brakes() const noexcept { return braking_ != nullptr; }
  /// Whether the value that was read last was not the safe one yet.
  [[nodiscard]] bool is_braking() const noexcept;
  /// Makes the safe value that has been read what is to be found now. If brakes(); by any reader, wait-free.
  void Brake(void* value, Publication& publication) noexcept;
  /// What has been read: of any stop, or none. By readers, wait-free.
  void NoteRead(const void* value, ValueTimes times) noexcept;
  void SetSubscribers(const Subscribers& subscribers, bool has_queue);
  /// Of the channel, and how often the value has changed on its way.
  [[nodiscard]] std::uint64_t publications() const noexcept;
  /// Whether a press has brought the safe value since it was taken last. By who takes.
  [[nodiscard]] bool has_to_take() const noexcept { return channel_->publications() > link_.taken; }
  /// Nobody is woken by it any more.
  void End() noexcept;

 private:
  struct Braking;
  [[nodiscard]] static std::unique_ptr<Braking> MakeBraking(const AnyValue& safe_value, const ChannelBase& channel);
  void Publish();
  [[nodiscard]] double Rest(Time now) noexcept;

  const PassedStop stop_;
  const std::unique_ptr<ChannelBase> channel_;
  const Runtime& runtime_;                  // its clock is another one when an application runs
  const std::unique_ptr<Braking> braking_;  // nullptr: the safe value is found at once
  InputLink link_{channel_.get()};
  std::mutex publisher_;  // both signals may tell at the same time
  StopSignal::Subscription robot_;
  StopSignal::Subscription block_;
};

}  // namespace runnel::internal
