#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include "bench/core/support/payloads.h"
#include "bench/core/support/waiting.h"

namespace runnel::bench {

/// Measures how long messages are on their way, one at a time: each waits until the one before has
/// come, and for a pause, so that the reader is waiting again.
///
/// Threads: SendAll() in one thread, Received() in the reader's, Percentile() when both are done.
class LatencyMeter {
 public:
  explicit LatencyMeter(std::uint64_t messages) : messages_(messages) { latencies_.reserve(messages); }
  [[nodiscard]] std::uint64_t messages() const noexcept { return messages_; }

  template <typename Send, typename Pause>
  void SendAll(Send&& send, Pause&& pause) {
    Message message{};
    for (message.number = 1; message.number <= messages_; ++message.number) {
      pause(message.number);
      message.sent = Now();
      send(message);
      for (Waiting waiting; received_.load(std::memory_order_acquire) < message.number;) {
        waiting.Pause();
      }
    }
  }
  void Received(const Message& message) {
    latencies_.push_back(static_cast<double>(Now() - message.sent));
    received_.store(message.number, std::memory_order_release);
  }
  /// Nanoseconds that `share` of the messages did not exceed.
  [[nodiscard]] double Percentile(double share) {
    const auto last = static_cast<double>(latencies_.size() - 1);
    const auto nth = latencies_.begin() + static_cast<std::ptrdiff_t>(share * last);
    std::nth_element(latencies_.begin(), nth, latencies_.end());
    return *nth;
  }

 private:
  static std::int64_t Now() {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
  }

  const std::uint64_t messages_;
  std::vector<double> latencies_;  // the reader's
  alignas(64) std::atomic<std::uint64_t> received_{0};
};

}  // namespace runnel::bench
