#include "plugins/genom_modules/async_worker.h"

namespace runnel::genom_modules {

AsyncWorker::~AsyncWorker() {
  thread_.request_stop();
  given_.Notify();
}

void AsyncWorker::Begin(genom_execution::AsyncWork& work) noexcept {
  work_.store(&work, std::memory_order_release);
  given_.Notify();
}

void AsyncWorker::WaitUntilBack() noexcept {
  while (work_.load(std::memory_order_acquire) != nullptr) back_.Wait();
}

bool AsyncWorker::WaitUntilBack(Time deadline) noexcept {
  const auto is_away = [this] { return work_.load(std::memory_order_acquire) != nullptr; };
  while (is_away() && SteadyClock().Now() < deadline) back_.WaitUntil(deadline);
  return !is_away();
}

void AsyncWorker::Run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    given_.Wait();
    genom_execution::AsyncWork* const work = work_.load(std::memory_order_acquire);
    if (work == nullptr) continue;
    work->Run();
    work_.store(nullptr, std::memory_order_release);
    back_.Notify();
  }
}

}  // namespace runnel::genom_modules
