#pragma once

#include <cstddef>
#include <vector>

namespace runnel {

/// Told by publishers that new data has come. Implemented by executors of event-driven modules.
///
/// Threads:  Wake() is called by any publishing thread, inside its cycle: it must neither block nor
///           allocate. After it has been taken off an input, wait for readers (WaitForReaders())
///           before destroying it.
class Waker {
 public:
  virtual void Wake() noexcept = 0;

 protected:
  ~Waker() = default;
};

class ProbeQueue;

/// The part of an input's queue that a channel keeps without knowing its type.
class QueueSink {
 public:
  virtual ~QueueSink() = default;
  /// How many values can wait.
  [[nodiscard]] virtual std::size_t capacity() const noexcept = 0;
  /// Itself, if it takes values of any type; else it takes those of its channel's.
  [[nodiscard]] virtual ProbeQueue* probe() noexcept { return nullptr; }
};

/// Those a publisher has to visit: queues and wakers. Readers of the latest value are not among
/// them; they look at the publisher's slot. Never changed once made; a channel swaps whole lists.
struct Subscribers {
  std::vector<QueueSink*> queues;  // of the channel's type
  std::vector<ProbeQueue*> probes;
  std::vector<Waker*> wakers;
  /// The only one of them, if that is a queue; set by the channel.
  QueueSink* only_queue = nullptr;

  [[nodiscard]] bool empty() const noexcept { return queues.empty() && probes.empty() && wakers.empty(); }
};

}  // namespace runnel
