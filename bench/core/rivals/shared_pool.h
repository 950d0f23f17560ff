#pragma once

#include <atomic>
#include <memory>
#include <vector>

namespace runnel::bench {

/// Reusable values behind shared_ptr: free is what only the pool itself still points to. One
/// publisher.
template <typename T>
class SharedPool {
 public:
  template <typename Make>
  SharedPool(std::size_t size, Make&& make) {
    for (std::size_t i = 0; i < size; ++i) values_.push_back(make());
  }

  /// nullptr if all are in use.
  [[nodiscard]] std::shared_ptr<T> Loan() {
    for (const std::shared_ptr<T>& value : values_) {
      if (value.use_count() > 1) continue;
      // acquire: what the last reader did with the value is over. use_count() itself is relaxed.
      std::atomic_thread_fence(std::memory_order_acquire);
      return value;
    }
    return nullptr;
  }

 private:
  std::vector<std::shared_ptr<T>> values_;
};

}  // namespace runnel::bench
