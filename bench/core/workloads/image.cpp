// Loan an image of 1920 x 1080 x 3 bytes and publish it, without filling it: what the framework
// itself costs.

#include <string>
#include <vector>

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/rivals/shared_pool.h"
#include "bench/core/support/counted.h"
#include "bench/core/support/images.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

constexpr std::size_t kBuffers = 4;

void PublishRunnel(benchmark::State& state, std::size_t readers) {
  Star<Image> star(readers, {}, {.pool = {.buffers = kBuffers}});
  PrepareImages(star.output());
  const InACycle cycle;
  for (auto _ : state) {
    auto loan = star.output().Loan();
    ++loan->number;
    star.output().Publish(std::move(loan));
  }
}

template <typename Cell>
void PublishPooled(benchmark::State& state, std::size_t cell_count) {
  SharedPool<Image> pool(kBuffers, MakeImage);
  std::vector<Cell> cells(cell_count);
  for (auto _ : state) {
    const auto loan = pool.Loan();
    ++loan->number;
    for (Cell& cell : cells) cell.Write(loan);
  }
}

template <typename Cell>
void AddPooled(Suite& suite, const std::string& name, std::size_t cells) {
  suite.Add(Role::kRival, name, [cells](benchmark::State& state) { PublishPooled<Cell>(state, cells); });
}

void AddReaders(Suite& suite, std::size_t readers) {
  suite.Start({.name = "loan + publish an image, " + Counted(readers, "input"),
               .family = "loan + publish an image",
               .axis = "inputs",
               .position = static_cast<double>(readers)});
  suite.Add(Role::kRunnel, "Loan, Publish", [readers](benchmark::State& state) { PublishRunnel(state, readers); });
  AddPooled<MutexSharedPointer<Image>>(suite, "mutex + shared_ptr, one for all", 1);
  AddPooled<MutexSharedPointer<Image>>(suite, "mutex + shared_ptr, one each", readers);
  AddPooled<AtomicSharedPointer<Image>>(suite, "atomic<shared_ptr>, one for all", 1);
}

}  // namespace

void AddImage(Suite& suite) {
  for (const std::size_t readers : {1u, 15u, 1000u}) AddReaders(suite, readers);
}

}  // namespace runnel::bench
