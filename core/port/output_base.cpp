#include "core/port/output_base.h"

#include <utility>

#include "core/base/check.h"

namespace runnel {

OutputBase::OutputBase(FrameworkElement& group, std::string&& name, const TypeInfo& type, OutputOptions&& options,
                       std::unique_ptr<ChannelBase>&& channel)
    : Port({group, std::move(name)}, Direction::kOutput, type, std::move(options.description)),
      unit_(std::move(options.unit)),
      channel_(channel.release()) {}

OutputBase::~OutputBase() {
  DisconnectAll();
  EndPulls();
  // Readers that found the channel before it was disconnected may still be looking at it.
  ChannelBase::DeleteLater(&own_channel());
}

std::uint64_t OutputBase::pull_failures() const noexcept {
  const PullPoint* const point = own_channel().pull_point();
  return point != nullptr ? point->failures() : 0;
}

std::uint64_t OutputBase::publications() const noexcept { return own_channel().publications(); }

bool OutputBase::is_pullable() const noexcept { return own_channel().pull_point() != nullptr; }

void OutputBase::SetPullProvider(PullPoint::Provider provider) {
  PullPoint* const point = own_channel().pull_point();
  RUNNEL_CHECK(point != nullptr, "an output without OutputOptions::pullable is given a provider");
  point->SetProvider(std::move(provider));
}

void OutputBase::Detach() noexcept {
  Port::Detach();
  EndPulls();
}

void OutputBase::EndPulls() {
  if (PullPoint* const point = own_channel().pull_point()) point->SetProvider({});
}

bool OutputBase::ExchangesChannels(Port& from) noexcept {
  const ChannelBase& other = static_cast<OutputBase&>(from).own_channel();
  return (own_channel().pull_point() == nullptr) == (other.pull_point() == nullptr);
}

void OutputBase::FollowExchange(Port& from) {
  if (!ExchangesChannels(from)) RebindSinks();
}

// The channels are exchanged, so that readers stay where they are, and each output keeps its
// provider. Where one can be pulled and the other cannot, the readers come over, and find nothing
// until something is published.
void OutputBase::ExchangeFlow(Port& from) noexcept {
  if (!ExchangesChannels(from)) return;
  auto& other = static_cast<OutputBase&>(from);
  ChannelBase& taken = other.own_channel();
  ChannelBase& left = own_channel();
  PullPoint* const point = taken.pull_point();
  if (point != nullptr) point->ExchangeProviders(*left.pull_point());
  channel_.store(&taken, std::memory_order_release);
  other.channel_.store(&left, std::memory_order_release);
}

}  // namespace runnel
