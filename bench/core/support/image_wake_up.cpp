// The least that the image transport can cost: the camera fills one image over and over, and one
// call of the system wakes all who sleep. Nothing keeps them apart from what is being filled.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "bench/core/support/image_stage.h"
#include "bench/core/support/images.h"
#include "core/lockfree/futex.h"

namespace runnel::bench {

ImageCost MeasureBareWakeUp(double seconds, int readers) {
  constexpr std::chrono::seconds kLong(10);
  Audience audience;
  const auto image = MakeImage();
  std::atomic<std::uint32_t> version{0};
  std::atomic<bool> is_over{false};
  std::vector<std::jthread> threads;
  for (int i = 0; i < readers; ++i) {
    threads.emplace_back([&] {
      for (std::uint32_t seen = version; !is_over; seen = version) {
        while (version == seen) {
          (void)KernelFutex::Sleep(version, seen, std::chrono::steady_clock::now() + kLong);
        }
        audience.LookAt(*image);
      }
    });
  }
  const auto wake_all = [&] {
    ++version;
    KernelFutex::Wake(version);
  };
  const ImageCost cost = CostOf(seconds, readers, audience, [&] {
    RunAtFiftyHertz(seconds, [&](std::uint64_t number) {
      FillImage(*image, number);
      wake_all();
    });
  });
  is_over = true;
  wake_all();
  return cost;
}

}  // namespace runnel::bench
