#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "modules/types/algorithm/point.h"

namespace runnel {

/// The last points of a kind, in order, in memory of a fixed size: once it is full, each new point
/// takes the place of the oldest. Copied freely.
class PointHistory {
 public:
  /// Every leave point of a variant that ends is nearer to the goal than the one before by the
  /// leave margin, so with 0.1 m this is enough for tasks of 25 m, and for most that are longer.
  static constexpr std::size_t kCapacity = 256;

  void Add(Point2 point) {
    points_[total_++ % kCapacity] = point;
    size_ = std::min(size_ + 1, kCapacity);
  }
  /// As if the last one had not been added (what it took the place of stays lost). Precondition:
  /// not empty.
  void RemoveLast() {
    --total_;
    --size_;
  }

  /// Of the points remembered.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Of the points there have been.
  [[nodiscard]] std::size_t total() const { return total_; }
  /// From 0, the oldest remembered, to size() - 1, the newest.
  [[nodiscard]] Point2 operator[](std::size_t i) const {
    return points_[(total_ - size_ + i) % kCapacity];
  }
  [[nodiscard]] Point2 back() const { return (*this)[size() - 1]; }

 private:
  friend struct KeptFields;  // names the members for a handover
  std::array<Point2, kCapacity> points_{};
  std::size_t total_ = 0;
  std::size_t size_ = 0;
};

}  // namespace runnel
