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
/// Threads: any; Ask() waits for nothing, and may be called by who holds other locks. Destroying it waits for the look that
///          is under way, and for one that has been asked for.
class Lookout {
 public:
  /// When to look again, by the machine's clock; nothing: when asked.
  using Look = std::function<std::optional<Time>()>;

  explicit Lookout(Look look) : look_(std::move(look)) {}
  ~Lookout();

  /// The first call makes the thread.
  void Ask();

 private:
  void Work();

  const Look look_;
  std::mutex mutex_;
  std::condition_variable has_changed_;
  bool is_asked_ = false;  // guarded by mutex_
  bool ends_ = false;      // guarded by mutex_
  std::thread thread_;     // so, until it is there
};

}  // namespace runnel
