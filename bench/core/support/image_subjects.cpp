#include "bench/core/support/image_subjects.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "bench/core/support/image_stage.h"
#include "bench/core/support/images.h"
#include "bench/core/support/process_cost.h"

namespace runnel::bench {

namespace {

using Clock = std::chrono::steady_clock;

ImageCost MeasureFilling(double seconds) {
  const auto image = MakeImage();
  FillImage(*image, 0);
  return CostOf(seconds, 0, {},
                [&] { RunAtFiftyHertz(seconds, [&](std::uint64_t number) { FillImage(*image, number); }); });
}

}  // namespace

void FillImage(Image& image, std::uint64_t number) {
  static const std::vector<unsigned char> original(kImageSize, 1);
  std::memcpy(image.pixels.data(), original.data(), kImageSize);
  image.pixels[kImageSize / 2] = static_cast<unsigned char>(number);
  image.number = number;
}

void RunAtFiftyHertz(double seconds, const std::function<void(std::uint64_t)>& fill) {
  const auto images = static_cast<std::uint64_t>(seconds / 0.02);
  auto due = Clock::now();
  for (std::uint64_t number = 1; number <= images; ++number) {
    fill(number);
    due += kImagePeriod;
    std::this_thread::sleep_until(due);
  }
}

ImageCost CostOf(double seconds, int readers, const Audience& audience, const std::function<void()>& run) {
  const std::uint64_t seen_before = audience.seen();
  const double used_before = ProcessSeconds();
  const auto start = Clock::now();
  run();
  const double taken = std::chrono::duration<double>(Clock::now() - start).count();
  const double images = std::max(1.0, seconds / 0.02) * readers;
  return {100 * (ProcessSeconds() - used_before) / taken, PeakMegabytes(),
          readers == 0 ? 1 : static_cast<double>(audience.seen() - seen_before) / images};
}

std::optional<ImageCost> MeasureImageSubject(const ImageTransport& transport) {
  if (transport.subject == kFillingSubject) return MeasureFilling(transport.seconds);
  if (transport.subject == kWakeUpSubject) {
    return MeasureBareWakeUp(transport.seconds, transport.readers);
  }
  if (transport.subject == kPortsSubject) {
    return MeasureImagePorts(transport.seconds, transport.readers);
  }
  if (transport.subject == kPoolSubject) {
    return MeasureImagePool(transport.seconds, transport.readers);
  }
  return std::nullopt;
}

}  // namespace runnel::bench
