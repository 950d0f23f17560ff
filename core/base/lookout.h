#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "core/base/clock.h"

namespace runnel {

/// A thread that looks at something when it is asked to, and again when the last look has said so.
///
/// Threads: any; Ask() waits for no look, and may be called by who holds other locks. Destroying it waits for the look that
///          is under way, and for one that has been asked for.
class Lookout {
 public:
  /// When to look again, by the machine's clock; nothing: when asked. If it throws, for lack of memory, soon.
  using Look = std::function<std::optional<Time>()>;

  explicit Lookout(Look look) : look_(std::move(look)) {}
  /// The first call makes the thread.
  void Ask() {
    const std::lock_guard lock(mutex_);
    is_asked_ = true;
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& end) { Work(end); });
    has_changed_.notify_all();
  }

 private:
  static constexpr Duration kSoon = std::chrono::milliseconds(10);

  void Work(const std::stop_token& end) {
    const auto is_asked = [this] { return is_asked_; };
    std::optional<Time> next;
    for (std::unique_lock lock(mutex_); !end.stop_requested() || is_asked_;) {
      if (next) {
        has_changed_.wait_for(lock, end, *next - SteadyClock().Now(), is_asked);
      } else {
        has_changed_.wait(lock, end, is_asked);
      }
      if (end.stop_requested() && !is_asked_) return;
      is_asked_ = false;
      lock.unlock();
      try {
        next = look_();
      } catch (...) {
        next = SteadyClock().Now() + kSoon;
      }
      lock.lock();
    }
  }

  const Look look_;
  std::mutex mutex_;
  std::condition_variable_any has_changed_;
  bool is_asked_ = false;  // guarded by mutex_
  std::jthread thread_;    // so, until it is there; first to go
};

}  // namespace runnel
