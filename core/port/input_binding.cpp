#include "core/port/input_binding.h"

namespace runnel::internal {

bool IsLater(const Publication& a, const InputLink& from_a, const Publication& b,
             const InputLink& from_b) noexcept {
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
