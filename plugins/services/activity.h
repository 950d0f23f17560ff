#pragma once

#include <atomic>
#include <cstdint>

#include "core/base/clock.h"
#include "plugins/services/call.h"

namespace runnel {

/// What a call that takes long says of itself, and is told. A handler that takes one as its first argument is run by a
/// thread of the service's own.
///
/// Threads: Report() and is_abort_asked() by the handler; the rest any.
class Activity {
 public:
  /// `fraction` from 0 to 1; `doing` is a literal, or lives as long.
  void Report(double fraction, const char* doing = "") noexcept {
    progress_.store(fraction, std::memory_order_relaxed);
    doing_.store(doing, std::memory_order_relaxed);
    call_->progress.store(fraction, std::memory_order_relaxed);
    call_->doing.store(doing, std::memory_order_relaxed);
  }
  /// The caller wants no answer any more, somebody has asked for an end, or the module is about to go, and waits for
  /// the handler: it should come to its end soon, with an error.
  [[nodiscard]] bool is_abort_asked() const noexcept {
    return is_abort_asked_.load(std::memory_order_relaxed) ||
           call_->is_given_up.load(std::memory_order_relaxed);
  }

  void Abort() noexcept { is_abort_asked_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] double progress() const noexcept { return progress_.load(std::memory_order_relaxed); }
  [[nodiscard]] const char* doing() const noexcept { return doing_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t number() const noexcept { return number_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool has_abort() const noexcept { return is_abort_asked_.load(std::memory_order_relaxed); }

  /// The service: the handler is about to be called.
  void Begin(CallBase& call) noexcept {
    call_ = &call;
    number_.store(call.number, std::memory_order_relaxed);
    is_abort_asked_.store(false, std::memory_order_relaxed);
    Report(0);
  }

 private:
  CallBase* call_ = nullptr;  // the handler's thread's
  std::atomic<std::uint64_t> number_{0};
  std::atomic<double> progress_{0};
  std::atomic<const char*> doing_{""};
  std::atomic<bool> is_abort_asked_{false};
};

}  // namespace runnel
