#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace runnel::bench {

/// The newest value on the heap; a mutex guards the pointer. What most hand-written code does, and
/// what rclcpp's and nodelets' transport within a process comes down to.
template <typename T>
class MutexSharedPointer {
 public:
  static constexpr const char* kName = "mutex + shared_ptr";

  void Write(const T& value) { Write(std::make_shared<const T>(value)); }
  void Write(std::shared_ptr<const T> value) {
    {
      const std::lock_guard lock(mutex_);
      value_.swap(value);
      ++version_;
    }  // what was there before goes after the lock has
  }
  [[nodiscard]] std::shared_ptr<const T> Lease() {
    const std::lock_guard lock(mutex_);
    return value_;
  }
  void Read(T& value) { value = *Lease(); }
  /// Only a value that has not been taken yet. One reader.
  bool Take(T& value) {
    std::shared_ptr<const T> lease;
    {
      const std::lock_guard lock(mutex_);
      if (version_ == taken_) return false;
      taken_ = version_;
      lease = value_;
    }
    value = *lease;
    return true;
  }

 private:
  alignas(64) std::mutex mutex_;
  std::uint64_t version_ = 0;
  std::uint64_t taken_ = 0;
  std::shared_ptr<const T> value_ = std::make_shared<const T>();
};

}  // namespace runnel::bench
