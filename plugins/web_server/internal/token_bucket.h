#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

namespace runnel::internal {

/// A token bucket for what one client may say: so many tokens come each second, those of a second can be
/// saved, and each message costs one and one more for each 4 kB.
class TokenBucket {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kBytesOfOne = 4096;

  TokenBucket(double messages_per_second, SteadyTime now)
      : rate_(messages_per_second), left_(messages_per_second), then_(now) {}

  void Consume(std::size_t bytes, SteadyTime now) {
    const double seconds = std::chrono::duration<double>(now - then_).count();
    left_ = std::min(rate_, left_ + rate_ * seconds);
    then_ = now;
    left_ -= CostOf(bytes);
  }
  [[nodiscard]] static double CostOf(std::size_t bytes) { return 1 + static_cast<double>(bytes / kBytesOfOne); }
  /// How long it has to be silent now; 0: it may go on.
  [[nodiscard]] std::chrono::nanoseconds Wait() const {
    if (left_ >= 0) return {};
    return std::chrono::nanoseconds(static_cast<std::int64_t>(-left_ / rate_ * 1e9) + 1);
  }
  /// So far beyond that it does not go by the rules.
  [[nodiscard]] bool IsFlood() const { return left_ < -10 * rate_; }

 private:
  const double rate_;
  double left_;
  SteadyTime then_;
};

}  // namespace runnel::internal
