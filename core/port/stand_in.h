#pragma once

#include <memory>

#include "core/channel/channel_base.h"
#include "core/port/port.h"

namespace runnel::internal {

/// An output, beside the tree, whose values readers find in the place of others: what is set by hand, what
/// becomes of values that are converted. It has no connections of its own: what is connected behind the port
/// at which it goes on is bound to it.
///
/// Threads: made under the structure lock. Who looks at ports may hold on to it for a while without that: goes
///          by Retire(), and touches nothing of the runtime then.
class StandIn final : public Port {
 public:
  StandIn(const Port& goes_on_at, std::unique_ptr<ChannelBase> channel);
  ~StandIn() override;

  void set_goes_on_at(const Port& port) noexcept { goes_on_at_ = &port; }
  [[nodiscard]] ChannelBase& own_channel() const noexcept { return *channel_; }

  bool VisitLatest(const Visitor& visit) const override { return channel_->VisitLatest(visit); }
  [[nodiscard]] std::uint64_t publications() const noexcept override { return channel_->publications(); }
  Result<PublishStatus> PublishFilled(const Fill& fill, std::optional<Time> timestamp = {}) override {
    return PublishInto(*channel_, fill, timestamp);
  }

 private:
  [[nodiscard]] ChannelBase* channel() noexcept override { return channel_.get(); }
  [[nodiscard]] const Port* goes_on_at() const noexcept override { return goes_on_at_; }

  const Port* goes_on_at_;
  const std::unique_ptr<ChannelBase> channel_;
};

/// Makes the value a copy of `value`, of the same type.
[[nodiscard]] Port::Fill FillWith(const AnyValue& value);

/// Destroys it when nobody can be looking at it any more.
void DeleteLater(std::unique_ptr<StandIn> stand_in);

/// An empty channel for values of the type, by whoever knows how to make one; nullptr if nobody does, or only a
/// module can make such values.
[[nodiscard]] std::unique_ptr<ChannelBase> MakeChannelFor(const TypeInfo& type);

}  // namespace runnel::internal
