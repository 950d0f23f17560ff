#include "bench/core/support/image_subjects.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "bench/core/rivals/shared_pool.h"
#include "bench/core/support/images.h"
#include "bench/core/support/process_cost.h"
#include "bench/core/support/star.h"
#include "core/module/module.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::bench {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPeriod(20);
constexpr std::size_t kBuffers = 4;

void Fill(Image& image, std::uint64_t number) {
  static const std::vector<unsigned char> original(kImageSize, 1);
  std::memcpy(image.pixels.data(), original.data(), kImageSize);
  image.pixels[kImageSize / 2] = static_cast<unsigned char>(number);
  image.number = number;
}

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

/// Lets `fill` run every 20 ms in this thread, until it is time.
void RunAtFiftyHertz(double seconds, const std::function<void(std::uint64_t)>& fill) {
  const auto images = static_cast<std::uint64_t>(seconds / 0.02);
  auto due = Clock::now();
  for (std::uint64_t number = 1; number <= images; ++number) {
    fill(number);
    due += kPeriod;
    std::this_thread::sleep_until(due);
  }
}

ImageCost CostOf(double seconds, int readers, const Audience& audience,
                 const std::function<void()>& run) {
  const std::uint64_t seen_before = audience.seen();
  const double used_before = ProcessSeconds();
  const auto start = Clock::now();
  run();
  const double taken = std::chrono::duration<double>(Clock::now() - start).count();
  const double images = std::max(1.0, seconds / 0.02) * readers;
  return {100 * (ProcessSeconds() - used_before) / taken, PeakMegabytes(),
          readers == 0 ? 1 : static_cast<double>(audience.seen() - seen_before) / images};
}

ImageCost MeasureFilling(double seconds) {
  const auto image = MakeImage();
  Fill(*image, 0);
  return CostOf(seconds, 0, {}, [&] {
    RunAtFiftyHertz(seconds, [&](std::uint64_t number) { Fill(*image, number); });
  });
}

class Camera final : public Module {
 public:
  using Module::Module;
  Output<Image> out{this, "out", {.pool = {.buffers = kBuffers}}};

 private:
  Result<void> Prepare() override {
    PrepareImages(out);
    return {};
  }
  void Update() override {
    auto loan = out.Loan();
    Fill(*loan, ++number_);
    out.Publish(std::move(loan));
  }

  std::uint64_t number_ = 0;
};

class Consumer final : public Module {
 public:
  Consumer(const Placement& placement, Audience& audience)
      : Module(placement), audience_(audience) {}
  Input<Image> in{this, "in", {.trigger = true}};

 private:
  void Update() override {
    if (const auto image = in.Read(); image.is_new()) audience_.LookAt(*image);
  }

  Audience& audience_;
};

ImageCost MeasurePorts(double seconds, int readers) {
  Audience audience;
  Runtime runtime;
  Scheduler scheduler(runtime);
  auto& camera = runtime.Create<Camera>(runtime.root(), "camera");
  AssignThread(camera, CreateThread(runtime, "camera", {.period = kPeriod}));
  for (int i = 0; i < readers; ++i) {
    const std::string name = "consumer" + std::to_string(i);
    auto& consumer = runtime.Create<Consumer>(runtime.root(), name, audience);
    MustSucceed(Port::Connect(camera.out, consumer.in));
    AssignThread(consumer,
                 CreateThread(runtime, name, {.activation = ThreadOptions::Activation::kTrigger}));
  }
  MustSucceed(runtime.MakeReady(runtime.root()));
  MustSucceed(scheduler.Start());
  const ImageCost cost = CostOf(seconds, readers, audience, [&] {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  });
  scheduler.Stop();
  return cost;
}

/// What a careful engineer writes by hand: the newest image behind a mutex, a condition variable
/// for those who wait for it, buffers that come back by their shared_ptr.
class Board {
 public:
  void Publish(std::shared_ptr<Image> image) {
    {
      const std::lock_guard lock(mutex_);
      image_.swap(image);
      ++version_;
    }
    changed_.notify_all();
  }
  /// nullptr at the end.
  std::shared_ptr<const Image> WaitForNewer(std::uint64_t& version) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return version_ != version || is_over_; });
    version = version_;
    return is_over_ ? nullptr : image_;
  }
  void End() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t version_ = 0;
  bool is_over_ = false;
  std::shared_ptr<Image> image_;
};

ImageCost MeasurePool(double seconds, int readers) {
  Audience audience;
  Board board;
  SharedPool<Image> pool(kBuffers, MakeImage);
  std::vector<std::jthread> threads;
  for (int i = 0; i < readers; ++i) {
    threads.emplace_back([&] {
      std::uint64_t version = 0;
      while (const auto image = board.WaitForNewer(version)) audience.LookAt(*image);
    });
  }
  const ImageCost cost = CostOf(seconds, readers, audience, [&] {
    RunAtFiftyHertz(seconds, [&](std::uint64_t number) {
      auto loan = pool.Loan();
      if (loan == nullptr) return;  // all readers are behind: this image is lost
      Fill(*loan, number);
      board.Publish(std::move(loan));
    });
  });
  board.End();
  return cost;
}

}  // namespace

std::optional<ImageCost> MeasureImageSubject(const ImageTransport& transport) {
  if (transport.subject == kFillingSubject) return MeasureFilling(transport.seconds);
  if (transport.subject == kPortsSubject) {
    return MeasurePorts(transport.seconds, transport.readers);
  }
  if (transport.subject == kPoolSubject) {
    return MeasurePool(transport.seconds, transport.readers);
  }
  return std::nullopt;
}

}  // namespace runnel::bench
