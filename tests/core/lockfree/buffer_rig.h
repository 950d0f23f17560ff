#pragma once

// What the searches of buffers share. searched_atomic.h must have been included before.

#include "core/lockfree/latest_buffer.h"

namespace runnel::test {

// Few slots and records, so that each way of holding comes up in short schedules.
template <typename T, std::size_t kReaders, std::size_t kSlots = 1>
struct Rig {
  using Domain = HazardDomain<SearchedAtomic, kSlots>;
  using Pool = BufferPool<T, SearchedAtomic, kSlots>;
  using Lease = BufferLease<T, SearchedAtomic, kSlots>;

  explicit Rig(const PoolOptions& options, typename Pool::Factory factory = {})
      : pool(Pool::Make(domain, options, std::move(factory))), latest(*pool) {
    for (auto& each : readers) domain.Add(each);
  }
  // Publishes `value` if there is a buffer.
  void Publish(int value) {
    auto* const buffer = latest.Loan();
    if (buffer == nullptr) return;
    buffer->value().Set(value);
    buffer->publication.sequence = static_cast<std::uint64_t>(value);
    latest.Publish(*buffer);
  }

  Domain domain;
  typename Domain::Record readers[kReaders];
  typename Pool::Owner pool;
  LatestBuffer<T, SearchedAtomic, kSlots> latest;
};

// The value may be looked at, and does not change. A buffer that is written while it is held is a
// race on its plain value.
template <typename Lease>
int LookAt(const Lease& lease) {
  const int value = lease.get()->value().Get();
  RL_ASSERT(value > 0);
  RL_ASSERT(static_cast<std::uint64_t>(value) == lease.get()->publication.sequence);
  RL_ASSERT(lease.get()->value().Get() == value);
  return value;
}

// A small, trivially copyable value, of which a publisher finds several free buffers at once: what is
// searched for races lies elsewhere.
struct Elsewhere {
  void Set(int value) const { plain->Set(value); }
  [[nodiscard]] int Get() const { return plain->Get(); }
  SearchedPlain* plain = nullptr;
};

// Counts how many of it there are; its death is a race if anybody still looks.
struct Mortal : SearchedPlain {
  Mortal() { ++alive(); }
  ~Mortal() {
    Set(-1);
    --alive();
  }
  static int& alive() {
    static int count = 0;
    return count;
  }
};

}  // namespace runnel::test
