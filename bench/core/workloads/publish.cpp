// What publishing a double costs the publisher, with 1 to 1000 readers connected.

#include <memory>
#include <string>
#include <vector>

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/boost_queues.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/support/counted.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

void PublishRunnel(benchmark::State& state, std::size_t readers) {
  Star<double> star(readers);
  const InACycle cycle;
  double value = 0;
  for (auto _ : state) star.output().Publish(value += 1);
}

// By a thread of the user's own, which is in no cycle: a driver that knows when it measured.
void PublishMeasured(benchmark::State& state, std::size_t readers) {
  Star<double> star(readers);
  const Time measured = star.runtime().clock().Now();
  double value = 0;
  for (auto _ : state) star.output().Publish(value += 1, measured);
}
// The same without a time: the clock is read for each value.
void PublishOutsideOfCycles(benchmark::State& state, std::size_t readers) {
  Star<double> star(readers);
  double value = 0;
  for (auto _ : state) star.output().Publish(value += 1);
}

// One place for all readers, as Runnel has it.
template <typename Cell>
void WriteOnce(benchmark::State& state) {
  Cell cell;
  double value = 0;
  for (auto _ : state) {
    cell.Write(value += 1);
    benchmark::ClobberMemory();
  }
}

// One place for each reader, all hold the same value.
void WriteToEach(benchmark::State& state, std::size_t readers) {
  std::vector<MutexSharedPointer<double>> cells(readers);
  double value = 0;
  for (auto _ : state) {
    const auto shared = std::make_shared<const double>(value += 1);
    for (auto& cell : cells) cell.Write(shared);
  }
}

// One queue for each reader; emptied outside of what is measured.
void PushToEach(benchmark::State& state, std::size_t readers) {
  constexpr std::size_t kCapacity = 1024;
  using Queue = BoostSpscQueue<double, kCapacity>;
  std::vector<std::unique_ptr<Queue>> queues;
  for (std::size_t i = 0; i < readers; ++i) queues.push_back(std::make_unique<Queue>());
  double value = 0;
  std::size_t waiting = 0;
  for (auto _ : state) {
    value += 1;
    for (auto& queue : queues) queue->Push(value);
    if (++waiting < kCapacity) continue;
    state.PauseTiming();
    for (auto& queue : queues) queue->Drain([](double each) { benchmark::DoNotOptimize(each); });
    waiting = 0;
    state.ResumeTiming();
  }
}

void AddReaders(Suite& suite, std::size_t readers) {
  suite.Start({.name = "publish a double, " + Counted(readers, "input"),
               .family = "publish a double",
               .axis = "inputs",
               .position = static_cast<double>(readers)});
  suite.Add(Role::kRunnel, "Publish", [readers](benchmark::State& state) { PublishRunnel(state, readers); });
  if (readers == 1) {
    suite.Add(Role::kRunnel, "Publish with its time, outside of cycles",
              [readers](benchmark::State& state) { PublishMeasured(state, readers); });
    suite.Add(Role::kRunnel, "Publish, outside of cycles",
              [readers](benchmark::State& state) { PublishOutsideOfCycles(state, readers); });
  }
  const std::string one = ", one for all";
  suite.Add(Role::kRival, Seqlock<double>::kName + one, WriteOnce<Seqlock<double>>);
  suite.Add(Role::kRival, MutexValue<double>::kName + one, WriteOnce<MutexValue<double>>);
  suite.Add(Role::kRival, AtomicSharedPointer<double>::kName + one, WriteOnce<AtomicSharedPointer<double>>);
  suite.Add(Role::kRival, "mutex + shared_ptr, one each",
            [readers](benchmark::State& state) { WriteToEach(state, readers); });
  suite.Add(Role::kRival, "boost spsc_queue, one each",
            [readers](benchmark::State& state) { PushToEach(state, readers); });
}

}  // namespace

void AddPublish(Suite& suite) {
  for (const std::size_t readers : {1u, 7u, 15u, 1000u}) AddReaders(suite, readers);
}

}  // namespace runnel::bench
