#include "core/port/input_binding.h"

#include "core/port/stop_link.h"

namespace runnel::internal {

bool IsLater(const Publication& a, const InputLink& from_a, const Publication& b, const InputLink& from_b) noexcept {
  if (a.order != 0 && b.order != 0) return a.order > b.order;
  if (a.publication_time != b.publication_time) return a.publication_time > b.publication_time;
  return from_a.number > from_b.number;
}

std::size_t InputBinding::WaitingInOlder() const noexcept {
  std::size_t sum = 0;
  for (const auto& older : older_queues) sum += older->size();
  return sum;
}

std::uint64_t InputBinding::dropped() const noexcept {
  std::uint64_t sum = dropped_before + (queue ? queue->dropped() : 0);
  for (const auto& older : older_queues) sum += older->dropped();
  return sum;
}

bool InputBinding::HasNext() const noexcept {
  for (const auto& older : older_queues) {
    if (older->HasNext()) return true;
  }
  return queue && queue->HasNext();
}

StopLink* InputBinding::StopBefore(std::optional<ValueTimes> times) const noexcept {
  StopLink* before = nullptr;
  for (const auto& each : stops) {
    const PortStop& stop = each->stop();
    const std::int64_t bar = stop.bar();
    if (times ? stop.LetsPass(*times) : bar == StopSignal::kNever) continue;
    if (before == nullptr || bar > before->stop().bar()) before = each.get();
  }
  return before;
}

StopLink* InputBinding::StopToTake() const noexcept {
  for (const auto& each : stops) {
    if (each->has_to_take()) return each.get();
  }
  return nullptr;
}

void InputBinding::NoteForStops(const void* value, ValueTimes times) const noexcept {
  for (const auto& each : stops) each->NoteRead(value, times);
}

std::shared_ptr<InputLink> InputBinding::LinkOf(const ChannelBase& source) const noexcept {
  for (const auto& link : links) {
    if (link->channel == &source) return link;
  }
  return nullptr;
}

InputLink* InputBinding::FindLinkOfSeveral(std::uint64_t number) const noexcept {
  for (const auto& link : links) {
    if (link->number == number) return link.get();
  }
  return nullptr;
}

}  // namespace runnel::internal
