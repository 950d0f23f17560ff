#include "plugins/services/service_worker.h"

#include <memory>
#include <utility>

#include "core/element/not_saved.h"

namespace runnel {

ServiceWorker::ServiceWorker(const Placement& placement,
                             std::function<void(CallBase&, Activity&)> serve,
                             std::function<void()> tell_free)
    : FrameworkElement(placement), serve_(std::move(serve)), tell_free_(std::move(tell_free)) {
  Annotate(std::make_unique<NotSaved>());
}

ServiceWorker::~ServiceWorker() {
  Stop();
  if (known_by_ != nullptr) *known_by_ = nullptr;
}

Result<void> ServiceWorker::Prepare() {
  if (!thread_.joinable()) thread_ = std::thread([this] { Work(); });
  return {};
}

void ServiceWorker::Begin(CallBase& call) noexcept {
  activity_.Begin(call);
  // release: pairs with the acquire in Work().
  current_.store(&call, std::memory_order_release);
  event_.Notify();
}

void ServiceWorker::Work() noexcept {
  for (;;) {
    event_.Wait();
    // acquire: pairs with the release in Begin().
    if (CallBase* const call = current_.load(std::memory_order_acquire)) {
      serve_(*call, activity_);
      current_.store(nullptr, std::memory_order_release);
      tell_free_();
    }
    if (is_stopping_.load(std::memory_order_acquire)) return;
  }
}

void ServiceWorker::AskToEnd() noexcept {
  activity_.Abort();
  is_stopping_.store(true, std::memory_order_release);
  event_.Notify();
}

void ServiceWorker::Stop() noexcept {
  if (!thread_.joinable()) return;
  AskToEnd();
  thread_.join();
}

}  // namespace runnel
