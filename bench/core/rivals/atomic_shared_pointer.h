#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace runnel::bench {

/// The newest value on the heap, its pointer in the standard's atomic<shared_ptr> (in libstdc++ a
/// spin lock in the pointer's low bit).
template <typename T>
class AtomicSharedPointer {
 public:
  static constexpr const char* kName = "atomic<shared_ptr>";

  void Write(const T& value) { Write(std::make_shared<const T>(value)); }
  void Write(std::shared_ptr<const T> value) { value_.store(std::move(value), std::memory_order_release); }
  [[nodiscard]] std::shared_ptr<const T> Lease() const { return value_.load(std::memory_order_acquire); }
  void Read(T& value) const { value = *Lease(); }
  /// Only a value that has not been taken yet. One reader. What was taken last is kept, so that its
  /// address cannot come back.
  bool Take(T& value) {
    std::shared_ptr<const T> lease = Lease();
    if (lease == taken_) return false;
    value = *lease;
    taken_ = std::move(lease);
    return true;
  }

 private:
  const std::shared_ptr<const T> first_ = std::make_shared<const T>();
  alignas(64) std::atomic<std::shared_ptr<const T>> value_{first_};
  alignas(64) std::shared_ptr<const T> taken_ = first_;  // the reader's own
};

}  // namespace runnel::bench
