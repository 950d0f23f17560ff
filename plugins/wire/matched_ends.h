#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <set>

namespace runnel {

/// Which endpoints there are at the other ends, for engines that tell of one after the other, and of each once.
///
/// Threads: any.
class MatchedEnds {
 public:
  /// One has come or gone. How many there are now: also one that there is no memory to note is counted, since nothing would be
  /// sent to it for ever after.
  std::size_t Change(std::uint64_t handle, bool is_there) noexcept {
    const std::lock_guard lock(mutex_);
    if (!is_there) {
      if (noted_.erase(handle) == 0 && unknown_ > 0) --unknown_;
      return noted_.size() + unknown_;
    }
    try {
      noted_.insert(handle);
    } catch (const std::bad_alloc&) {
      ++unknown_;
    }
    return noted_.size() + unknown_;
  }
  /// Whether it is there, as far as is known.
  [[nodiscard]] bool Has(std::uint64_t handle) const {
    const std::lock_guard lock(mutex_);
    return unknown_ > 0 || noted_.contains(handle);
  }

 private:
  mutable std::mutex mutex_;
  std::set<std::uint64_t> noted_;  // guarded by mutex_, as is the other
  std::size_t unknown_ = 0;
};

}  // namespace runnel
