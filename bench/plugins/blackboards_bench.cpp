// A map of 10^6 cells that one owner keeps, writers change by one cell and readers look at; beside a mutex and a shared
// pointer, where a writer copies the map to change it, and a mutex alone, where readers hold up writers.

#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/port/cycle.h"
#include "plugins/blackboards/blackboard.h"
#include "plugins/blackboards/blackboard_writer.h"

namespace runnel {
namespace {

using Cells = std::vector<float>;
constexpr std::size_t kCells = 1'000'000;

class Owner final : public Module {
 public:
  using Module::Module;
  Blackboard<Cells> map{this, "map", Cells(kCells, 0.0f)};

 private:
  void Update() override {}
};
class User final : public Module {
 public:
  using Module::Module;
  BlackboardWriter<Cells> map{this, "map", {.timeout = std::chrono::hours(1)}};

 private:
  void Update() override {}
};

/// Others who look at a value again and again while a case is measured.
class Readers {
 public:
  template <typename Look>
  Readers(std::int64_t count, const Look& look) {
    for (; count > 0; --count) {
      threads_.emplace_back([this, look] {
        while (!is_over_.load(std::memory_order_relaxed)) {
          benchmark::DoNotOptimize(look());
          std::this_thread::yield();
        }
      });
    }
  }
  ~Readers() {
    is_over_ = true;
    for (std::thread& each : threads_) each.join();
  }

 private:
  std::atomic<bool> is_over_{false};
  std::vector<std::thread> threads_;
};

struct Board {
  explicit Board(std::size_t writers) {
    for (std::size_t i = 0; i < writers; ++i) {
      auto& user = runtime.Create<User>(runtime.root(), "user" + std::to_string(i));
      (void)Port::Connect(owner.map.port(), user.map.value());
      (void)Port::Connect(owner.map.changes().port(), user.map.changes().port());
      users.push_back(&user);
    }
  }
  Runtime runtime;
  Owner& owner = runtime.Create<Owner>(runtime.root(), "owner");
  std::vector<User*> users;
};

// One commit of one cell by each writer, in a cycle.
void Commit(benchmark::State& state) {
  Board board(static_cast<std::size_t>(state.range(0)));
  auto& input = board.users.front()->map.value();
  const Readers readers(state.range(1), [&input] {
    const auto read = input.Peek();
    return (*read)[kCells / 2];
  });
  std::uint64_t index = 0;
  for (auto _ : state) {
    const OwnCycle cycle(board.runtime.clock().Now());
    for (User* user : board.users) {
      auto transaction = user->map.Begin();
      transaction.change().push_back({index++ % kCells, 1.0f});
      (void)transaction.CommitAnyway();
    }
    board.owner.map.changes().Serve();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
void CommitByMutexAndSharedPointer(benchmark::State& state) {
  std::mutex mutex;
  auto map = std::make_shared<const Cells>(kCells, 0.0f);
  const Readers readers(state.range(1), [&] {
    std::shared_ptr<const Cells> read;
    {
      const std::lock_guard lock(mutex);
      read = map;
    }
    return (*read)[kCells / 2];
  });
  std::uint64_t index = 0;
  for (auto _ : state) {
    for (std::int64_t writer = state.range(0); writer > 0; --writer) {
      auto next = std::make_shared<Cells>(*map);
      (*next)[index++ % kCells] = 1.0f;
      const std::lock_guard lock(mutex);
      map = std::move(next);
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
void Read(benchmark::State& state) {
  Board board(1);
  auto& input = board.users.front()->map.value();
  const OwnCycle cycle(board.runtime.clock().Now());
  float sum = 0;
  for (auto _ : state) sum += (*input.Read())[7];
  benchmark::DoNotOptimize(sum);
}
void ReadByMutexAndSharedPointer(benchmark::State& state) {
  std::mutex mutex;
  auto map = std::make_shared<const Cells>(kCells, 0.0f);
  float sum = 0;
  for (auto _ : state) {
    std::shared_ptr<const Cells> read;
    {
      const std::lock_guard lock(mutex);
      read = map;
    }
    sum += (*read)[7];
  }
  benchmark::DoNotOptimize(sum);
}

BENCHMARK(Commit)->ArgNames({"writers", "readers"})->Args({1, 0})->Args({1, 1})->Args({1, 4})->Args({4, 1});
BENCHMARK(CommitByMutexAndSharedPointer)
    ->ArgNames({"writers", "readers"})
    ->Args({1, 0})
    ->Args({1, 1})
    ->Args({1, 4})
    ->Args({4, 1});
BENCHMARK(Read);
BENCHMARK(ReadByMutexAndSharedPointer);

}  // namespace
}  // namespace runnel
