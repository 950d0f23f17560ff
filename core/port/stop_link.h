#pragma once

#include <memory>
#include <mutex>

#include "core/base/clock.h"
#include "core/channel/channel_base.h"
#include "core/port/input_binding.h"
#include "core/port/port_stop.h"

namespace runnel::internal {

/// What an input is bound to besides its sources: a stop, with a channel that has the safe value as its newest. A press
/// publishes it anew, so that whoever waits is woken, and finds it once as new.
///
/// Threads:  made and ended under the structure lock; a press publishes in its own thread, with neither that lock nor
///           a cycle.
class StopLink {
 public:
  /// `channel`: empty, of the input's type. Throws if the value cannot be copied.
  StopLink(PassedStop stop, std::unique_ptr<ChannelBase> channel, const Clock& clock);
  ~StopLink();
  StopLink(const StopLink&) = delete;
  StopLink& operator=(const StopLink&) = delete;

  /// Whether it is that stop, with the same safe value: one that was converted is another object each time.
  [[nodiscard]] bool Is(const PassedStop& stop) const;
  [[nodiscard]] const PortStop& stop() const noexcept { return *stop_.stop; }
  [[nodiscard]] ChannelBase& channel() const noexcept { return *channel_; }
  [[nodiscard]] InputLink& link() noexcept { return link_; }
  /// Whether a press has brought the safe value since it was taken last. By who takes.
  [[nodiscard]] bool has_to_take() const noexcept { return channel_->publications() > link_.taken; }
  /// Nobody is woken by it any more.
  void End() noexcept;

 private:
  void Publish();

  const PassedStop stop_;
  const std::unique_ptr<ChannelBase> channel_;
  const Clock& clock_;
  InputLink link_{channel_.get()};
  std::mutex publisher_;  // both signals may tell at the same time
  StopSignal::Subscription robot_;
  StopSignal::Subscription block_;
};

}  // namespace runnel::internal
