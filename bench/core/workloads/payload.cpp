// What it costs to fill a value, publish it and look at it, against its size. Filling copies from a
// source, looking reads the first and the last byte. Whoever cannot lend a value in place has to
// copy it out as well: that is what this shows.

#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/rivals/shared_pool.h"
#include "bench/core/support/payloads.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

constexpr std::size_t kBuffers = 4;
constexpr std::size_t kLargestSeqlock = 65536;

template <std::size_t kSize>
void LookAt(const Payload<kSize>& value) {
  benchmark::DoNotOptimize(value.bytes.front() + value.bytes.back());
}

// The source changes each time, so that no copy can be left out.
template <std::size_t kSize>
class Source {
 public:
  void Fill(Payload<kSize>& value) {
    ++value_->bytes[0];
    std::memcpy(&value, value_.get(), kSize);
  }

 private:
  std::unique_ptr<Payload<kSize>> value_ = std::make_unique<Payload<kSize>>();
};

template <std::size_t kSize>
void RunRunnel(benchmark::State& state) {
  using T = Payload<kSize>;
  Star<T> star(1, {}, {.pool = {.buffers = kBuffers}});
  Source<kSize> source;
  const InACycle cycle;
  for (auto _ : state) {
    auto loan = star.output().Loan();
    source.Fill(*loan);
    star.output().Publish(std::move(loan));
    LookAt(*star.input(0).Read());
  }
}

template <std::size_t kSize, typename Cell>
void RunCopied(benchmark::State& state) {
  using T = Payload<kSize>;
  const auto cell = std::make_unique<Cell>();
  const auto written = std::make_unique<T>();
  const auto read = std::make_unique<T>();
  Source<kSize> source;
  for (auto _ : state) {
    source.Fill(*written);
    cell->Write(*written);
    cell->Read(*read);
    LookAt(*read);
  }
}

template <std::size_t kSize, typename Cell>
void RunPooled(benchmark::State& state) {
  using T = Payload<kSize>;
  SharedPool<T> pool(kBuffers, [] { return std::make_shared<T>(); });
  Cell cell;
  Source<kSize> source;
  for (auto _ : state) {
    auto loan = pool.Loan();
    source.Fill(*loan);
    cell.Write(std::move(loan));
    LookAt(*cell.Lease());
  }
}

template <std::size_t kSize>
void RunFloor(benchmark::State& state) {
  const auto value = std::make_unique<Payload<kSize>>();
  Source<kSize> source;
  for (auto _ : state) {
    source.Fill(*value);
    benchmark::ClobberMemory();
    LookAt(*value);
  }
}

Workload OfSize(std::size_t size) {
  return {.name = "fill + publish + look, " + std::to_string(size) + " B",
          .family = "fill + publish + look",
          .axis = "bytes",
          .position = static_cast<double>(size)};
}

template <std::size_t kSize>
void AddSize(Suite& suite) {
  using T = Payload<kSize>;
  suite.Start(OfSize(kSize));
  suite.Add(Role::kRunnel, "Loan, Publish, Read", RunRunnel<kSize>);
  if constexpr (kSize <= kLargestSeqlock) {
    suite.Add(Role::kRival, "seqlock", RunCopied<kSize, Seqlock<T>>);
  }
  suite.Add(Role::kRival, "mutex + value", RunCopied<kSize, MutexValue<T>>);
  suite.Add(Role::kRival, "mutex + shared_ptr, pool", RunPooled<kSize, MutexSharedPointer<T>>);
  suite.Add(Role::kRival, "atomic<shared_ptr>, pool", RunPooled<kSize, AtomicSharedPointer<T>>);
  suite.Add(Role::kFloor, "filling alone", RunFloor<kSize>);
}

}  // namespace

void AddPayload(Suite& suite) {
  AddSize<8>(suite);
  AddSize<64>(suite);
  AddSize<128>(suite);
  AddSize<256>(suite);
  AddSize<1024>(suite);
  AddSize<8192>(suite);
  AddSize<65536>(suite);
  AddSize<1048576>(suite);
  AddSize<kImageSize>(suite);
}

}  // namespace runnel::bench
