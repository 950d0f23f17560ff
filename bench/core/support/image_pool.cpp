// The image transport as it is written by hand, with what the standard library has.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "bench/core/rivals/shared_pool.h"
#include "bench/core/support/image_stage.h"
#include "bench/core/support/images.h"

namespace runnel::bench {

namespace {

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

}  // namespace

ImageCost MeasureImagePool(double seconds, int readers) {
  Audience audience;
  Board board;
  SharedPool<Image> pool(kImageBuffers, MakeImage);
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
      FillImage(*loan, number);
      board.Publish(std::move(loan));
    });
  });
  board.End();
  return cost;
}

}  // namespace runnel::bench
