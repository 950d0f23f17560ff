// Lease the newest image and let it go, 1 to all threads at once from one port: whether readers
// disturb each other. The figure is what it costs one thread. It should be what it costs with a port
// for each thread, whatever the cores of the machine share.

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/support/counted.h"
#include "bench/core/support/images.h"
#include "bench/core/support/pinned_thread.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

std::size_t IndexOf(const benchmark::State& state) { return static_cast<std::size_t>(state.thread_index()); }

void ReadAgainAndAgain(Input<Image>& input, benchmark::State& state) {
  const InACycle cycle;
  for (auto _ : state) {
    const auto lease = input.Read();
    benchmark::DoNotOptimize(lease->number);
  }
}

// Each thread has an input of its own, all connected to the same output.
class ReadersOfOnePort {
 public:
  explicit ReadersOfOnePort(std::size_t threads) : star_(threads) { star_.output().Publish(Image{}); }
  void Run(benchmark::State& state) { ReadAgainAndAgain(star_.input(IndexOf(state)), state); }

 private:
  Star<Image> star_;
};

// What the cores can do when the threads have nothing to do with each other.
class ReadersOfTheirOwn {
 public:
  explicit ReadersOfTheirOwn(std::size_t threads) {
    for (std::size_t i = 0; i < threads; ++i) {
      stars_.push_back(std::make_unique<Star<Image>>(1));
      stars_.back()->output().Publish(Image{});
    }
  }
  void Run(benchmark::State& state) { ReadAgainAndAgain(stars_[IndexOf(state)]->input(0), state); }

 private:
  std::vector<std::unique_ptr<Star<Image>>> stars_;
};

template <typename Cell>
class PointerReaders {
 public:
  explicit PointerReaders(std::size_t) { cell_.Write(std::make_shared<const Image>()); }

  void Run(benchmark::State& state) {
    for (auto _ : state) {
      const auto lease = cell_.Lease();
      benchmark::DoNotOptimize(lease->number);
    }
  }

 private:
  Cell cell_;
};

template <typename Readers>
void AddReaders(Suite& suite, Role role, const std::string& name, int threads) {
  const auto readers = std::make_shared<Readers>(static_cast<std::size_t>(threads));
  suite
      .Add(role, name,
           [readers](benchmark::State& state) {
             const PinnedThread core(IndexOf(state));
             readers->Run(state);
           })
      ->Threads(threads);
}

// Powers of two, and all there are.
std::set<int> ThreadCounts() {
  const int all = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::set<int> counts = {1, all};
  for (int count = 2; count < all; count *= 2) counts.insert(count);
  return counts;
}

}  // namespace

void AddLease(Suite& suite) {
  for (const int threads : ThreadCounts()) {
    suite.Start({.name = "lease a large value, " + Counted(static_cast<std::size_t>(threads), "thread"),
                 .family = "lease a large value",
                 .axis = "threads",
                 .position = static_cast<double>(threads)});
    AddReaders<ReadersOfOnePort>(suite, Role::kRunnel, "Read", threads);
    AddReaders<ReadersOfTheirOwn>(suite, Role::kFloor, "a port for each", threads);
    AddReaders<PointerReaders<MutexSharedPointer<Image>>>(suite, Role::kRival, MutexSharedPointer<Image>::kName,
                                                          threads);
    AddReaders<PointerReaders<AtomicSharedPointer<Image>>>(suite, Role::kRival, AtomicSharedPointer<Image>::kName,
                                                           threads);
  }
}

}  // namespace runnel::bench
