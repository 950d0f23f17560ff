#pragma once

#include <cstddef>

namespace runnel {

/// What one value that comes from outside may take while it is read: a few bytes can promise much, and
/// can be nested as deep as they are long.
class ReadingLimits {
 public:
  static constexpr int kMostNested = 100;
  static constexpr std::size_t kMostBytes = std::size_t{1} << 28;  // of elements, 256 MiB

  /// While one lives, what is read is one level deeper.
  class Level {
   public:
    explicit Level(ReadingLimits& limits) noexcept : limits_(limits) { ++limits_.nested_; }
    ~Level() { --limits_.nested_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    [[nodiscard]] bool is_too_deep() const noexcept { return limits_.nested_ > kMostNested; }

   private:
    ReadingLimits& limits_;
  };

  /// Room for `count` further elements of `size` bytes; false, and nothing taken, if that is too much.
  [[nodiscard]] bool Take(std::size_t count, std::size_t size) noexcept {
    if (size > 0 && count > (kMostBytes - bytes_) / size) return false;
    bytes_ += count * size;
    return true;
  }

 private:
  int nested_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace runnel
