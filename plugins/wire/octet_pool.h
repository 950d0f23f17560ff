#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "plugins/wire/wire.h"

namespace runnel {

/// Octets that are used again once nobody has them any more, so that large ones are not allocated for each value. At
/// most `kMost` wait.
///
/// Threads: any. What it has given out may outlive it.
class OctetPool {
 public:
  static constexpr std::size_t kMost = 4;

  /// Empty, with the capacity that it has had before.
  [[nodiscard]] std::shared_ptr<Octets> Take() {
    std::unique_ptr<Octets> octets;
    {
      const std::lock_guard lock(free_->mutex);
      if (!free_->octets.empty()) {
        octets = std::move(free_->octets.back());
        free_->octets.pop_back();
      }
    }
    if (octets == nullptr) octets = std::make_unique<Octets>();
    octets->clear();
    return {octets.release(), [free = free_](Octets* back) {
              std::unique_ptr<Octets> owned(back);
              const std::lock_guard lock(free->mutex);
              if (free->octets.size() < kMost) free->octets.push_back(std::move(owned));
            }};
  }

 private:
  struct Free {
    std::mutex mutex;
    std::vector<std::unique_ptr<Octets>> octets;
  };
  const std::shared_ptr<Free> free_ = [] {
    auto made = std::make_shared<Free>();
    made->octets.reserve(kMost);
    return made;
  }();
};

}  // namespace runnel
