#pragma once

#include <atomic>
#include <cstdint>

namespace runnel {

class ScheduledElement;

/// Which element a thread is just running, for those who look from outside of the thread.
///
/// Threads:   Begin() and End() by the thread of the cycles; the rest by any. Progress: wait-free, two plain stores.
class RunningTask {
 public:
  void Begin(const ScheduledElement& element) noexcept {
    // One thread writes, so nothing is lost between load and store.
    count_.store(count_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    // release: pairs with the acquire in Look(): who finds the element finds its count, or a later one.
    element_.store(&element, std::memory_order_release);
  }
  void End() noexcept { element_.store(nullptr, std::memory_order_release); }

  struct State {
    const ScheduledElement* element = nullptr;  ///< nullptr: none; it may be gone by now
    std::uint64_t count = 0;                    ///< of the runs so far
    friend bool operator==(const State&, const State&) = default;
  };
  /// Two looks that find the same element and the same count have found the same run.
  [[nodiscard]] State Look() const noexcept {
    const auto* const element = element_.load(std::memory_order_acquire);
    return {element, count_.load(std::memory_order_relaxed)};
  }
  [[nodiscard]] const ScheduledElement* element() const noexcept { return element_.load(std::memory_order_relaxed); }

 private:
  std::atomic<const ScheduledElement*> element_{nullptr};
  std::atomic<std::uint64_t> count_{0};
};

/// The path of the module that the calling thread is just running; nullptr if it runs none, or if that is not noted
/// (SchedulerOptions::notes_running_tasks). May be called by the handler of a signal.
[[nodiscard]] const char* RunningModulePath() noexcept;

}  // namespace runnel
