#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <thread>
#include <type_traits>

#include <pybind11/pybind11.h>

namespace runnel::python {

/// Counts for as long as it lives.
template <typename Count>
class Counted {
 public:
  explicit Counted(Count& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Count& count_;
};

/// What a thread is within, and what has interrupted it.
struct ThreadPlace {
  int cycles = 0;  ///< cycles, services and locks: see GilInCycle; uses of modules' ports
  int uses = 0;    ///< these alone
  int calls = 0;   ///< calls of applications
  std::exception_ptr interrupt = nullptr;
};
inline thread_local ThreadPlace this_thread_place;

/// In a forked child: `error` has ended what it was forked in, or None.
[[noreturn]] void EndChild(pybind11::handle error);

/// The GIL for who runs a cycle or a service, or has a lock: nothing is waited for until it is given back. A child that
/// was forked meanwhile ends then: it has none of the other threads, and what would go on is its parent's.
class GilInCycle {
 public:
  GilInCycle() = default;
  ~GilInCycle() {
    if (this_thread_place.cycles <= 0) EndChild(pybind11::none());
  }

 private:
  Counted<int> within_{this_thread_place.cycles};
  pybind11::gil_scoped_acquire gil_;  // given back first, for that may end objects
};

/// Throws in a cycle, a service or under a lock.
void CheckMayWait();

/// Keeps what is no error but ends a program (KeyboardInterrupt, SystemExit) for the call in which this thread runs cycles.
/// False: it is an error, or no call does. In a cycle, with the GIL; a child that was forked in it ends.
bool KeepInterrupt(const pybind11::error_already_set& thrown);
/// Throws what has been kept.
void ThrowInterrupt();

/// Of those that will want the GIL again: who wants it when the interpreter has gone is ended in the middle of what it does.
inline std::atomic<int> threads_without_gil{0};
/// The thread that ends the interpreter, when others are not to want it any more: they stand still, and the process ends soon.
inline std::atomic<std::thread::id> ends_in{};
class ReleasedGil {
 public:
  ReleasedGil() = default;
  ~ReleasedGil();

 private:
  Counted<std::atomic<int>> counted_{threads_without_gil};
  pybind11::gil_scoped_release released_;
};

/// Does what may wait, lock or run cycles: never with the GIL, which a module in Python may need first.
template <typename Work>
auto WithoutGil(const Work& work) {
  const auto released = [&] {
    const ReleasedGil gil;
    return work();
  };
  if constexpr (std::is_void_v<std::invoke_result_t<Work>>) {
    released();
    ThrowInterrupt();
  } else {
    auto result = released();
    ThrowInterrupt();
    return result;
  }
}

/// Throws what the handler of a signal has: Ctrl-C, say. With the GIL.
void ThrowSignal();

/// Until it is so, with the GIL, which others have meanwhile.
template <typename Condition>
void AwaitWithGil(const Condition& is_so) {
  while (!is_so()) {
    const ReleasedGil released;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Ends something that may wait, without the GIL: at once, or where nothing may be waited for in a thread of its own.
void EndWithoutGil(std::function<void()> end);
/// In a thread of its own, which is waited for when the interpreter ends.
void EndInThread(std::function<void()> end);
/// Waits, with the GIL, for all that are without it: this thread ends the interpreter. Ctrl-C ends it.
void AwaitAll();
/// How often this process and those before it have forked: what was made before another number is another process's.
inline std::atomic<int> forks{0};
/// In a forked child, whose only thread this is: it is within nothing of what its parent was in.
void BeginAsChild();

}  // namespace runnel::python
