#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "core/element/framework_element.h"
#include "core/lockfree/wake_event.h"
#include "plugins/services/activity.h"

namespace runnel {

/// The thread of a service whose calls take long. It begins when the module gets ready. When the module is taken out the
/// handler is asked to end; it is waited for when the module is destroyed, before any of the module's members goes, and
/// not under the structure lock, which the handler may want.
///
/// Threads: Begin() by the module's cycle; activity() from any.
class ServiceWorker final : public FrameworkElement {
 public:
  /// `tell_free`: called when a call is over and the next may begin.
  ServiceWorker(const Placement& placement, std::function<void(CallBase&, Activity&)> serve,
                std::function<void()> tell_free);
  ~ServiceWorker() override;

  // acquire: pairs with the release in Work(): the call before is over.
  [[nodiscard]] bool is_free() const noexcept {
    return current_.load(std::memory_order_acquire) == nullptr;
  }
  /// Precondition: is_free().
  void Begin(CallBase& call) noexcept;
  [[nodiscard]] const Activity& activity() const noexcept { return activity_; }
  void Abort() noexcept { activity_.Abort(); }
  /// The module owns it; `service` knows where it is, as long as it is there.
  void set_known_by(ServiceWorker** service) noexcept { known_by_ = service; }
  /// Asks the handler to end, and waits for it.
  void Stop() noexcept;

 private:
  Result<void> Prepare() override;
  void Detach() noexcept override { AskToEnd(); }
  void AskToEnd() noexcept;
  void Work() noexcept;

  const std::function<void(CallBase&, Activity&)> serve_;
  const std::function<void()> tell_free_;
  Activity activity_;
  std::atomic<CallBase*> current_{nullptr};
  std::atomic<bool> is_stopping_{false};
  WakeEvent event_;
  std::thread thread_;
  ServiceWorker** known_by_ = nullptr;
};

}  // namespace runnel
