#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "bench/core/rivals/seqlock.h"

namespace runnel::bench {

/// The newest value, guarded by a mutex; its reader sleeps on a condition variable.
template <typename T>
class ConditionValue {
 public:
  static constexpr const char* kName = "mutex + condition variable";

  void Write(const T& value) {
    {
      const std::lock_guard lock(mutex_);
      value_ = value;
      ++version_;
    }
    changed_.notify_one();
  }
  /// Sleeps until there is a value that has not been taken. One reader.
  void WaitAndTake(T& value) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return version_ != taken_; });
    taken_ = version_;
    value = value_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t version_ = 0;
  std::uint64_t taken_ = 0;
  T value_{};
};

/// A seqlock whose reader sleeps by the standard's atomic wait (a futex).
template <typename T>
class WaitedSeqlock {
 public:
  static constexpr const char* kName = "seqlock + atomic wait";

  void Write(const T& value) {
    value_.Write(value);
    version_.fetch_add(1, std::memory_order_seq_cst);
    version_.notify_one();
  }
  /// Sleeps until there is a value that has not been taken. One reader.
  void WaitAndTake(T& value) {
    for (;;) {
      const std::uint32_t version = version_.load(std::memory_order_seq_cst);
      if (value_.Take(value)) return;
      version_.wait(version, std::memory_order_seq_cst);
    }
  }

 private:
  Seqlock<T> value_;
  alignas(64) std::atomic<std::uint32_t> version_{0};
};

}  // namespace runnel::bench
