#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace runnel::internal {

/// Faults on their way from the thread that runs the application to the server's.
///
/// Threads:  any.
class FaultLog {
 public:
  struct Entry {
    std::string path;  ///< of a module
    std::string message;
  };

  void Add(std::string path, std::string message) {
    const std::lock_guard lock(mutex_);
    ++count_;
    if (entries_.size() < kMostEntries) entries_.push_back({std::move(path), std::move(message)});
  }
  [[nodiscard]] std::vector<Entry> Take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(entries_, {});
  }
  /// Of all so far.
  [[nodiscard]] std::uint64_t count() const {
    const std::lock_guard lock(mutex_);
    return count_;
  }

 private:
  static constexpr std::size_t kMostEntries = 10'000;  // while no viewer is there to take them

  mutable std::mutex mutex_;  // a leaf
  std::vector<Entry> entries_;
  std::uint64_t count_ = 0;
};

}  // namespace runnel::internal
