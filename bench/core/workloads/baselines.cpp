// What the other figures are compared with: what one step costs that a rival cannot do without.

#include <atomic>
#include <chrono>
#include <cstring>
#include <memory>
#include <mutex>
#include <vector>

#include "bench/core/support/payloads.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

void LockAndUnlock(benchmark::State& state) {
  std::mutex mutex;
  for (auto _ : state) {
    mutex.lock();
    benchmark::ClobberMemory();
    mutex.unlock();
  }
}

void CopySharedPointer(benchmark::State& state) {
  const auto original = std::make_shared<int>(1);
  for (auto _ : state) {
    auto copy = original;
    benchmark::DoNotOptimize(copy);
  }
}

void CopyMatrix(benchmark::State& state) {
  Matrix4 from{};
  Matrix4 to{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(&from);
    std::memcpy(&to, &from, sizeof(Matrix4));
    benchmark::DoNotOptimize(&to);
    benchmark::ClobberMemory();
  }
}

void CopyImage(benchmark::State& state) {
  const std::vector<unsigned char> from(kImageSize, 1);
  std::vector<unsigned char> to(kImageSize, 2);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), kImageSize);
    benchmark::ClobberMemory();
  }
}

void ReadClock(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(std::chrono::steady_clock::now());
}

}  // namespace

void AddFetchAdd(Suite& suite) {
  suite.Add(Role::kBaseline, kFetchAdd, [](benchmark::State& state) {
    alignas(64) std::atomic<std::uint64_t> count{0};
    for (auto _ : state) {
      benchmark::DoNotOptimize(count.fetch_add(1, std::memory_order_relaxed));
    }
  });
}

void AddBaselines(Suite& suite) {
  suite.Start({kBaselineWorkload});
  suite.Add(Role::kBaseline, "mutex lock + unlock", LockAndUnlock);
  suite.Add(Role::kBaseline, "shared_ptr copy + destroy", CopySharedPointer);
  suite.Add(Role::kBaseline, "memcpy of 128 B", CopyMatrix);
  suite.Add(Role::kBaseline, "memcpy of 6,220,800 B", CopyImage);
  suite.Add(Role::kBaseline, "steady_clock::now", ReadClock);
}

}  // namespace runnel::bench
