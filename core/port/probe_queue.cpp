#include "core/port/probe_queue.h"

namespace runnel {

void ProbeQueue::PushBytes(const void* value, std::size_t size, const Publication& publication,
                           std::uint64_t source) noexcept {
  if (values_.TryEmplace(value, size, publication, source)) return;
  // relaxed: a statistic.
  dropped_.fetch_add(1, std::memory_order_relaxed);
}

void ProbeQueue::PushHold(const Hold& hold, const Publication& publication,
                          std::uint64_t source) noexcept {
  if (values_.TryEmplace(hold, publication, source)) return;
  hold.release(hold.buffer);
  dropped_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace runnel
