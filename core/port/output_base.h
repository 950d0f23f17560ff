#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "core/channel/channel_base.h"
#include "core/port/port.h"

namespace runnel {

/// The part of an output that does not depend on the type of its values.
class OutputBase : public Port {
 public:
  ~OutputBase() override;

  /// Whether a queue that refuses when it is full would refuse the next value, as things are. A
  /// publisher that must not lose anything waits until it would not: publishing again what a queue
  /// has refused makes a new value for all others. For the publisher's thread; if the queue has no
  /// other sources, what is not refused now will not be.
  [[nodiscard]] bool WouldRefuse() const noexcept { return own_channel().WouldRefuse(); }
  /// How many pulls have come to nothing because the provider threw or had no buffer.
  [[nodiscard]] std::uint64_t pull_failures() const noexcept;
  [[nodiscard]] std::uint64_t publications() const noexcept override;
  [[nodiscard]] bool is_pullable() const noexcept override;
  [[nodiscard]] const std::string& unit() const noexcept override { return unit_; }
  bool VisitLatest(const Visitor& visit) const override { return own_channel().VisitLatest(visit); }
  Result<PublishStatus> PublishFilled(const Fill& fill, std::optional<Time> timestamp = {}) override {
    return PublishInto(own_channel(), fill, timestamp);
  }

 protected:
  // By reference, so that typed outputs move nothing themselves.
  OutputBase(FrameworkElement& group, std::string&& name, const TypeInfo& type, OutputOptions&& options,
             std::unique_ptr<ChannelBase>&& channel);

  // acquire: pairs with the release in ExchangeFlow(), for viewers; publishers are at rest then.
  [[nodiscard, gnu::always_inline]] ChannelBase& own_channel() const noexcept {
    return *channel_.load(std::memory_order_acquire);
  }
  /// Errors: throws ProgrammingError if the output is not pullable.
  void SetPullProvider(PullPoint::Provider provider);

 private:
  [[nodiscard]] ChannelBase* channel() noexcept override { return &own_channel(); }
  void Detach() noexcept override;
  void ExchangeFlow(Port& from) noexcept override;
  void FollowExchange(Port& from) override;
  [[nodiscard]] bool ExchangesChannels(Port& from) noexcept;
  void EndPulls();

  const std::string unit_;
  std::atomic<ChannelBase*> channel_;  // owned
};

}  // namespace runnel
