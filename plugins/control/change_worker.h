#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace runnel {

/// Does what may take long, so that the thread that talks to clients need not wait: changes, which wait
/// for cycles to end, and saving. One thing after the other.
///
/// Threads:  Post() and destroying by one thread. What has not begun when it is destroyed is not done.
class ChangeWorker {
 public:
  /// Something to do, as its client sees it.
  class Job {
   public:
    [[nodiscard]] bool is_done() const noexcept { return is_done_.load(std::memory_order_acquire); }
    /// If it has not begun it never will.
    void Cancel() noexcept { is_cancelled_.store(true); }

   private:
    friend class ChangeWorker;
    std::function<void()> work_;
    std::atomic<bool> is_cancelled_{false};
    // release when done: who sees it sees what the work has done.
    std::atomic<bool> is_done_{false};
  };

  /// `on_done` is called by the worker's thread after each job.
  explicit ChangeWorker(std::function<void()> on_done);
  ~ChangeWorker();
  ChangeWorker(const ChangeWorker&) = delete;
  ChangeWorker& operator=(const ChangeWorker&) = delete;

  std::shared_ptr<Job> Post(std::function<void()> work);
  /// Whether the calling thread is the worker of any.
  [[nodiscard]] static bool IsThisThread() noexcept;

 private:
  void Work();

  const std::function<void()> on_done_;
  std::mutex mutex_;
  std::condition_variable has_work_;
  std::deque<std::shared_ptr<Job>> jobs_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace runnel
