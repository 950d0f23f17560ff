#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "plugins/parameters/parameter.h"

namespace runnel::genom_modules {

/// A parameter that its module sets, too: what it says is what the module has made of it.
///
/// Threads: Take() and Follow() by the module's cycle, and never blocked; the rest as of parameters.
template <typename T>
class FollowingParameter final : public ParameterBase {
 public:
  FollowingParameter(FrameworkElement* module, std::string name, const ParameterOptions<T>& options)
      : ParameterBase(module, std::move(name), internal::DescriptionOf(options, false), &options.default_value),
        value_(options.default_value) {}

  [[nodiscard]] std::shared_ptr<void> Value() const override {
    const Hold hold(is_held_, true);
    return std::make_shared<T>(value_);
  }
  /// Whether somebody has set it since; `use(value)` is called then. False also if somebody is just looking at it: then
  /// a later call says so.
  template <typename Use>
  bool Take(const Use& use) {
    if (!has_changed_.load(std::memory_order_relaxed)) return false;
    const Hold hold(is_held_, false);
    if (!hold.has()) return false;
    has_changed_.store(false, std::memory_order_relaxed);
    use(std::as_const(value_));
    return true;
  }
  /// The module has this value now. False: somebody is just looking at it, try again. What somebody has set since counts.
  bool Follow(const T& value) {
    const Hold hold(is_held_, false);
    if (!hold.has()) return false;
    if (!has_changed_.load(std::memory_order_relaxed)) value_ = value;
    return true;
  }

 private:
  // acquire and release: the value is handed over.
  class Hold {
   public:
    Hold(std::atomic_flag& flag, bool waits) : flag_(flag), has_(!flag.test_and_set(std::memory_order_acquire)) {
      for (; waits && !has_; has_ = !flag.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
    }
    ~Hold() {
      if (has_) flag_.clear(std::memory_order_release);
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    [[nodiscard]] bool has() const noexcept { return has_; }

   private:
    std::atomic_flag& flag_;
    bool has_;
  };

  bool Assign(const void* value) override {
    const Hold hold(is_held_, true);
    value_ = *static_cast<const T*>(value);
    has_changed_.store(true, std::memory_order_relaxed);
    return true;
  }

  mutable std::atomic_flag is_held_ = ATOMIC_FLAG_INIT;
  T value_;                                // by who holds it
  std::atomic<bool> has_changed_{false};  // changed by who holds it
};

}  // namespace runnel::genom_modules
