#pragma once

#include <array>
#include <mutex>

namespace runnel::bench {

/// A bounded queue guarded by a mutex.
template <typename T, std::size_t kCapacity = 1024>
class MutexRing {
 public:
  static constexpr const char* kName = "mutex ring";

  bool Push(const T& value) {
    const std::lock_guard lock(mutex_);
    if (written_ - taken_ == kCapacity) return false;
    values_[written_++ % kCapacity] = value;
    return true;
  }
  bool Take(T& value) {
    const std::lock_guard lock(mutex_);
    if (written_ == taken_) return false;
    value = values_[taken_++ % kCapacity];
    return true;
  }

 private:
  alignas(64) std::mutex mutex_;
  std::size_t written_ = 0;
  std::size_t taken_ = 0;
  std::array<T, kCapacity> values_{};
};

}  // namespace runnel::bench
