#pragma once

#include <cstdint>
#include <mutex>

namespace runnel::bench {

/// The newest value, guarded by a mutex.
template <typename T>
class MutexValue {
 public:
  static constexpr const char* kName = "mutex + value";

  void Write(const T& value) {
    const std::lock_guard lock(mutex_);
    value_ = value;
    ++version_;
  }
  void Read(T& value) {
    const std::lock_guard lock(mutex_);
    value = value_;
  }
  /// Only a value that has not been taken yet. One reader.
  bool Take(T& value) {
    const std::lock_guard lock(mutex_);
    if (version_ == taken_) return false;
    value = value_;
    taken_ = version_;
    return true;
  }

 private:
  alignas(64) std::mutex mutex_;
  std::uint64_t version_ = 0;
  std::uint64_t taken_ = 0;
  T value_{};
};

}  // namespace runnel::bench
