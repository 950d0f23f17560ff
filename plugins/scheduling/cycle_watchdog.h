#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/lookout.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/fault.h"

namespace runnel {

/// How long a module may take for one run of a task, and what is done when it takes longer.
struct StuckRule {
  std::string of = "/";  ///< path: this element and all below it, or all that a thread of this path runs
  Duration after{};      ///< of the machine's clock; 0: it may take as long as it likes
  /// Called as a FaultRule's are, once for each run that takes too long ...
  std::function<void(const Fault&)> on_stuck = {};
  bool ends_run = false;  ///< as FaultRule's, of `on_stuck`
  /// ... and when it has come to its end after all.
  std::function<void(const Fault&)> on_return = {};
};

/// A module that has not returned from its cycle within its time.
struct StuckModule {
  std::string path;
  std::string thread;  ///< path of its container
  Duration since{};    ///< at least
};

/// Looks at what the threads of either clock are running, and names who does not return: as a fault (kStuck) for each
/// rule, while it is stuck.
///
/// Cycles note the element that they run by plain stores. A thread of this class compares what it finds from look to
/// look, four times in the shortest allowed time, and so needs no clock in the cycle: a module is named between its
/// time and a quarter more after it has begun.
///
/// Threads:    any, but not within a cycle.
/// Ownership:  `faults` and `clock` outlive it.
class CycleWatchdog {
 public:
  using Runners = std::vector<std::shared_ptr<CycleRunner>>;

  CycleWatchdog(FaultDispatcher& faults, const Clock& clock) : faults_(faults), clock_(clock) {}
  ~CycleWatchdog() { End(); }

  /// Counts from the next look on. Precondition: after > 0.
  void Add(StuckRule rule);
  /// A time for all at and below `of` that is only told of, in the place of one that was set so before. "": for all of
  /// which no other rule says anything. Zero: none.
  void SetLimit(const std::string& of, Duration after);
  /// Is called again and again while a module is stuck, by the watchdog's thread. Waits for the one before.
  void SetListener(std::function<void()> listener);
  /// All of the rules, those of SetLimit() too.
  [[nodiscard]] std::vector<StuckRule> rules() const;
  [[nodiscard]] bool has_rules() const;
  void MovePaths(const std::function<void(std::string& path)>& move);

  /// Whom to look at.
  void Follow(Runners runners);
  /// Looks, until End().
  void Begin();
  void End();

  [[nodiscard]] std::vector<StuckModule> Stuck() const;
  /// `patience`: also where no rule says so, if one run of a task has taken longer.
  [[nodiscard]] bool IsStuck(const CycleRunner& runner, Duration patience = Duration::max()) const;

 private:
  struct KnownRule {
    StuckRule rule;
    bool is_limit = false;  // by SetLimit()
    [[nodiscard]] bool IsDefault() const { return rule.of.empty(); }
  };
  // What one runner runs, as of the last look.
  struct Watched {
    std::shared_ptr<CycleRunner> runner;
    RunningTask::State state = {};
    Time seen{};  // first
    std::string path = {};
    // With room for all rules.
    std::vector<std::shared_ptr<KnownRule>> fired = {}, returned = {};
    std::size_t told = 0;  // of those that have fired; none, while there is a return to be told of
    // Of the run that has returned:
    std::string path_of_returned = {};
    Duration lasted{};
  };

  std::optional<Time> LookAround();
  void Look(Time now);
  void Look(Watched& watched, Time now);
  void TellStuck(Watched& watched, Time now);
  [[nodiscard]] bool IsAbout(const KnownRule& known, const std::string& path, const std::string& thread) const;
  void TellReturned(Watched& watched);
  void Tell(const Watched& watched, Fault fault, const std::function<void(const Fault&)>& call, bool ends_run = false);
  [[nodiscard]] Duration Interval() const;
  void MakeRoom();
  void Change();

  FaultDispatcher& faults_;
  const Clock& clock_;
  mutable std::mutex mutex_;  // a leaf but for the dispatcher's
  // Guarded by mutex_:
  std::vector<std::shared_ptr<KnownRule>> rules_;
  std::vector<Watched> watched_;
  std::mutex listening_;              // not under mutex_
  std::function<void()> listener_;    // guarded by listening_
  std::unique_ptr<Lookout> lookout_;  // between Begin() and End(); guarded by mutex_
};

}  // namespace runnel
