#pragma once

#include <vector>

#include "core/lockfree/bounded_queue.h"
#include "plugins/genom_execution/execution_task.h"

namespace runnel::genom_execution {

/// Takes requests one at a time: checks and validates them, does what attributes and functions do, has activities
/// interrupted, started and answered.
///
/// Threads: Run() by one thread at a time; Send() by any.
class ControlTask {
 public:
  explicit ControlTask(Engine& engine);

  [[nodiscard]] bool Send(Request& request) noexcept;
  /// One pass: until nothing waits, or a codel may not run yet (kWaiting).
  Pass Run();
  /// Everything is to end, permanent activities in the reverse order of their tasks; true when all has.
  [[nodiscard]] bool ShutDown();
  [[nodiscard]] bool is_away() const noexcept { return runner_.is_away(); }

 private:
  enum class Step : std::uint8_t { kValidate, kAssign, kCodels, kInterrupt };

  [[nodiscard]] bool Reap();
  [[nodiscard]] bool StartPending();
  void Begin(Request& request);
  /// False: a codel may not run yet.
  [[nodiscard]] bool GoOn();
  [[nodiscard]] bool RunCodels(std::span<const std::uint16_t> codels);
  void Abort(Request& request);
  void Interrupt(ActivitySlot& slot, const char* by);
  void InterruptAll(const ServiceTable& service);
  void Finish(Request& request);
  void Free(ActivitySlot& slot);
  [[nodiscard]] ActivitySlot* FindFree(const ServiceTable& service);
  [[nodiscard]] bool MayStart(const ActivitySlot& slot) const;
  [[nodiscard]] bool IsAllowed(const ServiceTable& service) const;
  template <typename Use>
  void ForEachActivity(Use use);

  Engine& engine_;
  BoundedQueue<Request*> queue_;
  CodelRunner runner_;
  std::vector<bool> has_succeeded_;  // by services
  std::uint32_t next_id_ = 1;
  std::vector<ActivitySlot*> pending_;  // in the order of their acceptance
  // The request that is being looked at.
  Request* request_ = nullptr;
  ActivitySlot* slot_ = nullptr;  // of an activity
  Step step_ = Step::kValidate;
  std::size_t position_ = 0;  // among the codels of the step
  std::size_t shut_down_ = 0;  // tasks, from the last, whose permanent activity has been told to end
};

}  // namespace runnel::genom_execution
