#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "bench/core/support/image_subjects.h"
#include "bench/core/support/payloads.h"

namespace runnel::bench {

// What all subjects of the image transport do alike.

inline constexpr std::chrono::milliseconds kImagePeriod(20);
inline constexpr std::size_t kImageBuffers = 4;

/// As a camera's driver does it: one copy of all pixels.
void FillImage(Image& image, std::uint64_t number);

/// What all readers together have seen.
class Audience {
 public:
  void LookAt(const Image& image) {
    const bool is_whole = image.pixels[kImageSize / 2] == static_cast<unsigned char>(image.number);
    if (is_whole) seen_.fetch_add(1, std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t seen() const { return seen_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> seen_{0};
};

/// Calls `fill` every 20 ms in this thread, until it is time.
void RunAtFiftyHertz(double seconds, const std::function<void(std::uint64_t)>& fill);

/// What the process uses while `run` does its work of so many seconds.
ImageCost CostOf(double seconds, int readers, const Audience& audience, const std::function<void()>& run);

// The subjects.
ImageCost MeasureImagePorts(double seconds, int readers);
ImageCost MeasureBareWakeUp(double seconds, int readers);
ImageCost MeasureImagePool(double seconds, int readers);

}  // namespace runnel::bench
