#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace runnel::bench {

/// One writer, one reader, three buffers: each has one of its own, and the third changes hands by
/// one exchange. Wait-free; the value is written and read in place.
template <typename T>
class TripleBuffer {
 public:
  static constexpr const char* kName = "triple buffer";

  void Write(const T& value) {
    back() = value;
    Publish();
  }
  /// In place: fill it, then Publish().
  [[nodiscard]] T& back() { return buffers_[back_].value; }
  void Publish() {
    // acq_rel: the reader sees the value; we see that it has finished with what we get.
    back_ = middle_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex;
  }
  /// In place: as it is until the next call.
  [[nodiscard]] const T& Front() {
    Refresh();
    return buffers_[front_].value;
  }
  void Read(T& value) { value = Front(); }
  /// Only a value that has not been taken yet.
  bool Take(T& value) {
    if (!Refresh()) return false;
    value = buffers_[front_].value;
    return true;
  }

 private:
  static constexpr std::uint32_t kNew = 4;
  static constexpr std::uint32_t kIndex = 3;

  bool Refresh() {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  struct alignas(64) Buffer {
    T value{};
  };
  std::array<Buffer, 3> buffers_{};
  alignas(64) std::atomic<std::uint32_t> middle_{1};
  alignas(64) std::uint32_t back_ = 0;   // the writer's own
  alignas(64) std::uint32_t front_ = 2;  // the reader's own
};

}  // namespace runnel::bench
