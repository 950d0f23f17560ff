#pragma once

#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/lookout.h"
#include "core/base/ordered_mutex.h"
#include "plugins/structure/change.h"
#include "plugins/supervision/supervisor.h"
#include "plugins/supervision/watches.h"

namespace runnel {

/// What a supervisor has in common with those who call it later: the scheduler, its thread beside.
struct Supervisor::Shared {
  struct KnownRule : SupervisionRule {
    std::optional<bool> is_applied = false;  // kPaused; nothing: a part of it, for lack of memory
    // Both by reaction.published, under the structure lock: set, and neither taken back nor released; to be set if an undo
    // brings the port back.
    std::vector<bool> holds = {};
    std::vector<bool> misses = {};
    Reaction back = {};  // under the structure lock: takes back what it has switched, as long as nobody has
  };
  Shared(Runtime& of_runtime, Scheduler& of_scheduler, Perform how)
      : runtime(of_runtime), scheduler(of_scheduler), perform(std::move(how)) {}

  void Note(Notice notice) {
    const std::lock_guard lock(mutex);
    notices.push_back(std::move(notice));
  }
  void MovePaths(const PathFollowers::Move& move);
  using Which = Reaction SupervisionRule::*;
  enum class Where { kBeside, kHere };
  void React(KnownRule& rule, Which which, const std::string& path, const std::string& why, Time now,
             bool is_recovery = false, Where where = Where::kBeside);
  Result<void> PublishAll(KnownRule& rule, Which which, const Reaction& reaction);
  Result<void> CarryOut(KnownRule& rule, Which which, Reaction& reaction, Time now);
  void NotePassing(KnownRule& rule, Which which, ChangeSet back,
                   std::vector<std::pair<std::size_t, std::uint64_t>>& noted);
  // What may take as long as it takes, and must keep up nobody who looks whether all is well: in real time beside him, one
  // after the other; in simulated time at once.
  void Beside(std::function<void()> act, bool is_long);
  void FollowPauses(std::string_view but_for);
  void FollowPausesAgain();
  void WorkBeside();
  void ServeRequests(Time now);
  Time LookForSilence(Time now);
  [[nodiscard]] bool is_real() const noexcept {
    return scheduler.options().clock == SchedulerOptions::ClockKind::kReal;
  }
  Result<void> Publish(const SafeValue& safe, const std::function<void(const Port& port)>& before = {});
  Result<void> Release(const std::string& port, Time now);
  Result<void> ReleaseEach(std::list<std::string>& ports, Time now);
  // What rules hold there. Under the structure lock.
  void VisitHeld(const Port& port, const std::function<void(KnownRule& rule, std::size_t number)>& visit);
  Time Watch(Time now);
  static std::function<void(const Fault&)> CallOf(const std::shared_ptr<Shared>& shared,
                                                  std::shared_ptr<KnownRule> rule, Which which, std::string why);
  Result<void> AddWatch(const std::shared_ptr<KnownRule>& rule);
  void KeepSafe(Time now);
  void PublishMissed(Time now);
  void TellOverruns(Time now);

  Runtime& runtime;
  Scheduler& scheduler;
  const Perform perform;

  internal::Standstill standstill;  // under the structure lock
  std::set<std::string> late;  // threads of which that has been told; of the thread that looks out, as the next one
  std::vector<std::pair<std::shared_ptr<KnownRule>, internal::StaleWatch>> watches;
  std::vector<std::shared_ptr<KnownRule>> rules;  // their paths are guarded by the structure lock
  std::vector<KnownRule*> switched;  // that have something to take back, the last one last; under the structure lock
  std::list<std::string> later;      // to be released, as soon as that can be done; under the structure lock
  std::mutex pausing;                // one after the other; before all others
  std::atomic<bool> has_pauses_left{false};  // to be followed
  OrderedMutex mutex{LockLevel::kLeaf};
  std::vector<Notice> notices;            // guarded by mutex
  std::list<std::function<void()>> acts;  // so; only the thread beside takes some away
  Lookout beside{[this]() -> std::optional<Time> {
    WorkBeside();
    return {};
  }};  // first to go: it uses the rest
};

}  // namespace runnel
