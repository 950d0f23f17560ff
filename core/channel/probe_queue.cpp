#include "core/channel/probe_queue.h"

namespace runnel {

void ProbeQueue::PushCopy(const void* value, std::size_t size, const Publication& publication,
                          std::uint64_t source) noexcept {
  if (values_.TryEmplace(value, size, publication, source)) return;
  // relaxed: a statistic.
  dropped_.fetch_add(1, std::memory_order_relaxed);
}

void ProbeQueue::PushReference(BufferReference reference, const void* value, const Publication& publication,
                               std::uint64_t source) noexcept {
  if (values_.TryEmplace(std::move(reference), value, publication, source)) return;
  dropped_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace runnel
