#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "core/element/framework_element.h"
#include "core/lockfree/wake_event.h"
#include "plugins/services/activity.h"

namespace runnel {

/// The thread of a service whose calls take long. It begins when the module gets ready; before the module goes the
/// handler is asked to end, and waited for.
///
/// Threads: Begin() by the module's cycle; activity() from any.
class ServiceWorker final : public FrameworkElement {
 public:
  ServiceWorker(FrameworkElement& port, std::function<void(CallBase&, Activity&)> serve);
  ~ServiceWorker() override;

  // acquire: pairs with the release in Work(): the call before is over.
  [[nodiscard]] bool is_free() const noexcept {
    return current_.load(std::memory_order_acquire) == nullptr;
  }
  /// Precondition: is_free().
  void Begin(CallBase& call) noexcept;
  [[nodiscard]] const Activity& activity() const noexcept { return activity_; }
  void Abort() noexcept { activity_.Abort(); }

 private:
  Result<void> Prepare() override;
  void Detach() noexcept override { Stop(); }
  void Work() noexcept;
  void Stop() noexcept;

  const std::function<void(CallBase&, Activity&)> serve_;
  Activity activity_;
  std::atomic<CallBase*> current_{nullptr};
  std::atomic<bool> is_stopping_{false};
  WakeEvent event_;
  std::thread thread_;
};

}  // namespace runnel
