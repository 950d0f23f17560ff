#include "plugins/control/change_worker.h"

#include <utility>

namespace runnel {

namespace {
thread_local bool is_worker = false;
}  // namespace

ChangeWorker::ChangeWorker(std::function<void()> on_done)
    : on_done_(std::move(on_done)), thread_([this] { Work(); }) {}

ChangeWorker::~ChangeWorker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_work_.notify_one();
  thread_.join();
}

std::shared_ptr<ChangeWorker::Job> ChangeWorker::Post(std::function<void()> work) {
  auto job = std::make_shared<Job>();
  job->work_ = std::move(work);
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(job);
  }
  has_work_.notify_one();
  return job;
}

bool ChangeWorker::IsThisThread() noexcept { return is_worker; }

void ChangeWorker::Work() {
  is_worker = true;
  std::unique_lock lock(mutex_);
  for (;;) {
    has_work_.wait(lock, [this] { return ends_ || !jobs_.empty(); });
    if (ends_) return;
    const std::shared_ptr<Job> job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    if (!job->is_cancelled_.load()) job->work_();
    job->work_ = nullptr;
    job->is_done_.store(true, std::memory_order_release);
    on_done_();
    lock.lock();
  }
}

}  // namespace runnel
