#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/ordered_mutex.h"
#include "core/lockfree/wake_event.h"
#include "plugins/scheduling/fault.h"

namespace runnel {

/// Room for one fault, made before it happens, so that raising it needs no memory.
class FaultRecord {
 public:
  explicit FaultRecord(std::string path);
  /// One that is known already, with what is to be done about it in the place of the rules.
  FaultRecord(Fault fault, std::function<void(const Fault&)> call, bool ends_run = false)
      : fault_(std::move(fault)), call_(std::move(call)), ends_run_(ends_run) {}
  /// Cuts `message` off where the room ends.
  void Fill(std::string_view message, Time time, std::uint64_t cycle) noexcept;
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }

 private:
  friend class FaultDispatcher;
  /// That memory, or a thread, was not there, for this one, or to have one in front of it mended.
  void NoteDue() noexcept;
  /// The same; whether that is so for long.
  [[nodiscard]] bool IsOverdue() noexcept;

  Fault fault_;
  std::function<void(const Fault&)> call_;
  bool ends_run_ = false;
  FaultRecord* next_ = nullptr;
  // How far it has been answered.
  bool is_acted_on_ = false;   // a thread has called what the handler returned
  bool is_for_rules_ = false;  // no handler mends it
  bool is_logged_ = false;
  std::size_t rule_ = 0;  // of those that apply to it, the first that has not been called
  Time due_since_{};      // by the machine's clock, as memory is short for what is to be done now
};

/// Takes faults from the cycles in which they happen to those who act on them and tell of them.
///
/// Threads:    Raise() from any cycle: lock-free, allocates nothing; wakes the supervising thread,
///             if one sleeps. The rest from any thread outside of cycles.
/// Ownership:  of records that have been raised.
class FaultDispatcher {
 public:
  ~FaultDispatcher();

  void Raise(std::unique_ptr<FaultRecord> record) noexcept;

  /// Applies the rules to what has been raised, in the order of raising, and logs it. Nothing while another thread
  /// is about it. False: there was no memory, or no thread, for some, which are due at the next call, from where they
  /// have got to; what has no memory for a second has failed.
  bool Dispatch() noexcept;
  /// Raises a fault of no cycle, and dispatches. Errors: no memory to raise it.
  void Report(Fault fault);
  /// Logs it, and applies no rule. Whatever there is no memory for is not logged.
  void Note(Fault fault) noexcept;
  /// What has been logged since the last call, oldest first, behind what is there. Errors: no memory; nothing is taken.
  void Take(std::vector<Fault>& to);

  /// See Scheduler::SetFaultHandler().
  using Action = std::function<std::string()>;
  using Handler = std::function<Action(const Fault&)>;
  void SetHandler(Handler handler);
  /// Whether threads of their own call what a handler returns. Waits for those that do.
  void SetActsBeside(bool acts_beside);

  void AddRule(FaultRule rule);
  void MovePaths(const std::function<void(std::string& path)>& move);

  void RequestStop() noexcept { stop_requested_.store(true, std::memory_order_release); }
  void EndForFault() noexcept {
    ended_by_fault_.store(true, std::memory_order_release);
    RequestStop();
  }
  void ClearStop() noexcept {
    ended_by_fault_.store(false, std::memory_order_release);
    stop_requested_.store(false, std::memory_order_release);
  }
  [[nodiscard]] bool stop_requested() const noexcept { return stop_requested_.load(std::memory_order_acquire); }

  /// A rule has requested it, whoever else has, too.
  [[nodiscard]] bool ended_by_fault() const noexcept { return ended_by_fault_.load(std::memory_order_acquire); }

  /// Notified of each fault.
  [[nodiscard]] WakeEvent& event() noexcept { return event_; }

 private:
  bool DispatchAlone() noexcept;
  void EndIfRuled(const FaultRecord& record) noexcept;
  [[nodiscard]] bool Answer(FaultRecord& record);
  void Log(Fault fault);
  void Act(FaultRecord& record, const Action& action);
  void ApplyRules(FaultRecord& record);
  template <typename Call>
  bool Try(FaultRecord& record, const std::string& of, const char* failed, const Call& call);

  // A stack that is only ever pushed to and taken as a whole, so no address can come back to life.
  std::atomic<FaultRecord*> raised_{nullptr};
  std::atomic<FaultRecord*> unanswered_{nullptr};  // for lack of memory, the oldest first; of who dispatches
  std::atomic<bool> is_dispatching_{false};
  std::atomic<bool> stop_requested_{false};
  std::atomic<bool> ended_by_fault_{false};
  WakeEvent event_;
  OrderedMutex mutex_{LockLevel::kLeaf};
  Handler handler_;                     // guarded by mutex_
  std::vector<FaultRule> rules_;        // guarded by mutex_
  std::vector<Fault> log_;              // guarded by mutex_
  std::optional<std::jthread> beside_;  // so; waits for the one before it
};

}  // namespace runnel
