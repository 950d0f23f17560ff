#include "plugins/command_service/lookout.h"

namespace runnel {

Lookout::~Lookout() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Lookout::Ask() {
  const std::lock_guard lock(mutex_);
  is_asked_ = true;
  if (!thread_.joinable()) thread_ = std::thread([this] { Work(); });
  has_changed_.notify_all();
}

void Lookout::Work() {
  std::optional<Time> next;
  const auto shall_look = [this] { return is_asked_ || ends_; };
  for (std::unique_lock lock(mutex_);;) {
    if (next) {
      has_changed_.wait_for(lock, *next - SteadyClock().Now(), shall_look);
    } else {
      has_changed_.wait(lock, shall_look);
    }
    if (ends_ && !is_asked_) return;
    is_asked_ = false;
    lock.unlock();
    next = look_();
    lock.lock();
  }
}

}  // namespace runnel
