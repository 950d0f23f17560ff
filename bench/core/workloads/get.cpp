// What it costs a reader to have a copy of the newest value, of 8 and of 128 bytes.

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/bare_copy.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/rivals/triple_buffer.h"
#include "bench/core/support/payloads.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

template <typename T>
void ReadRunnel(benchmark::State& state) {
  Star<T> star(1);
  Input<T>& input = star.input(0);
  const InACycle cycle;
  star.output().Publish(T{});
  for (auto _ : state) {
    const auto lease = input.Read();
    T value = *lease;
    benchmark::DoNotOptimize(&value);
    benchmark::ClobberMemory();
  }
}

template <typename T>
void GetRunnel(benchmark::State& state) {
  Star<T> star(1);
  const Input<T>& input = star.input(0);
  const InACycle cycle;
  star.output().Publish(T{});
  for (auto _ : state) {
    T value = input.Get();
    benchmark::DoNotOptimize(&value);
    benchmark::ClobberMemory();
  }
}

// By a thread of the user's own, which is in no cycle.
template <typename T>
void GetOutsideOfCycles(benchmark::State& state) {
  Star<T> star(1);
  const Input<T>& input = star.input(0);
  star.output().Publish(T{});
  for (auto _ : state) {
    T value = input.Get();
    benchmark::DoNotOptimize(&value);
    benchmark::ClobberMemory();
  }
}

template <typename T, typename Cell>
void ReadCell(benchmark::State& state) {
  Cell cell;
  cell.Write(T{});
  for (auto _ : state) {
    T value;
    cell.Read(value);
    benchmark::DoNotOptimize(&value);
    benchmark::ClobberMemory();
  }
}

template <typename T, template <typename> class Cell>
void AddCell(Suite& suite, Role role = Role::kRival) {
  suite.Add(role, Cell<T>::kName, ReadCell<T, Cell<T>>);
}

template <typename T>
void AddSubjects(Suite& suite) {
  suite.Add(Role::kRunnel, "Get", GetRunnel<T>);
  suite.Add(Role::kRunnel, "Read", ReadRunnel<T>);
  suite.Add(Role::kRunnel, "Get, outside of cycles", GetOutsideOfCycles<T>);
  AddCell<T, Seqlock>(suite);
  AddCell<T, TripleBuffer>(suite);
  AddCell<T, MutexValue>(suite);
  AddCell<T, MutexSharedPointer>(suite);
  AddCell<T, AtomicSharedPointer>(suite);
  AddCell<T, BareCopy>(suite, Role::kFloor);
}

}  // namespace

void AddGet(Suite& suite) {
  suite.Start({"get a copy of a double"});
  AddSubjects<double>(suite);
  suite.Start({"get a copy of 128 B"});
  AddSubjects<Matrix4>(suite);
}

}  // namespace runnel::bench
