#include "core/port/probe_port.h"

#include <algorithm>
#include <exception>
#include <new>

#include "core/channel/channel_base.h"
#include "core/channel/probe_queue.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

ProbePort::ProbePort(FrameworkElement& group, std::string name, const TypeInfo& type, std::size_t capacity)
    : InputBase({group, std::move(name)}, type, {}), queue_(std::make_unique<ProbeQueue>(capacity)) {}

ProbePort::~ProbePort() {
  SetWaker(nullptr);
  DisconnectAll();
  // Publishers that found the queue before it was disconnected may still be filling it.
  Retire([queue = queue_.release()] { delete queue; });
}

bool ProbePort::Take(const Visitor& visit) {
  bool is_taken = false;
  std::exception_ptr failure;
  const auto take = [&](const void* value, const Publication& publication, std::uint64_t source) {
    if (!IsNewer(publication.sequence, source)) return;
    is_taken = true;
    last_source_ = source;
    try {
      visit(value, ValueTimes::Of(publication));
    } catch (...) {
      failure = std::current_exception();
    }
  };
  while (!is_taken) {
    if (!queue_->TryTake(take)) return false;
  }
  if (failure) std::rethrow_exception(failure);
  return true;
}

bool ProbePort::IsNewer(std::uint64_t sequence, std::uint64_t source) noexcept {
  try {
    std::uint64_t& last = taken_[source];
    if (sequence <= last) return false;
    last = sequence;
  } catch (const std::bad_alloc&) {  // better twice than not at all
  }
  return true;
}

std::size_t ProbePort::waiting() const noexcept { return queue_->size(); }
std::size_t ProbePort::capacity() const noexcept { return queue_->capacity(); }
std::uint64_t ProbePort::dropped() const noexcept { return queue_->dropped(); }
bool ProbePort::HasNew() const { return queue_->HasNext(); }

QueueSink* ProbePort::Bind(const std::vector<Source>& sources) {
  std::vector<std::uint64_t> bound;
  fresh_.clear();
  for (const Source& source : sources) {
    ChannelBase* const channel = ChannelOf(*source.output);
    bound.push_back(channel->number());
    if (std::ranges::count(bound_, channel->number()) == 0) fresh_.push_back(channel);
  }
  bound_ = std::move(bound);
  return sources.empty() ? nullptr : queue_.get();
}

// Publishers know of the queue by now, so none of their values is lost between this one and those.
void ProbePort::Bound() {
  const EpochGuard guard;
  for (ChannelBase* channel : fresh_) channel->DeliverNewest(*queue_);
  fresh_.clear();
}

void ProbePort::TakeOverBinding(InputBase& from) noexcept {
  auto& other = static_cast<ProbePort&>(from);
  queue_.swap(other.queue_);
  bound_.swap(other.bound_);
  taken_.swap(other.taken_);
}

}  // namespace runnel
