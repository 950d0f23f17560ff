#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugins/control/command.h"
#include "plugins/structure/change_text.h"

namespace runnel {

/// A change set that a client has asked for, while it is carried out: plugins that its types need are
/// loaded, it goes through the history if there is one, into the log, and new modules that take the place
/// of others are looked after until they have proved themselves.
///
/// Threads:  one; works in that of the worker. Destroyed before it has begun, it is not done.
class ClientChange {
 public:
  /// How often to ask whether it is over.
  static constexpr Duration kLookWhetherOver = std::chrono::milliseconds(20);
  /// Changes in one set at most; what is longer is for the client's end to refuse.
  static constexpr std::size_t kMostChanges = 20'000;

  /// `label` is for the history; "": the changes in their text form.
  ClientChange(PlacedChanges placed, std::string label, const ControlledApplication& application,
               ChangeWorker& worker);
  ~ClientChange();
  ClientChange(const ClientChange&) = delete;
  ClientChange& operator=(const ClientChange&) = delete;

  /// Goes on. True: it is over, and the following can be asked for.
  bool Continue();

  [[nodiscard]] const ChangeOutcome& outcome() const;
  /// Modules whose successors have thrown in one of their first cycles: they are back.
  [[nodiscard]] std::vector<Error> SwappedBack() const;
  /// Some new module has not run all the cycles of its probation yet, 3 s after.
  [[nodiscard]] bool is_on_probation() const;
  /// "done; threads stood still for 0.110 ms".
  [[nodiscard]] std::string DoneText() const;

 private:
  // A replaced module, to find out whether the new one is still there a moment later.
  struct Swap {
    std::string path;
    std::uint64_t before = 0;  // serial of the old one
    bool is_back = false;
  };
  // What worker and client share; the client may be gone before the worker is done.
  struct State {
    PlacedChanges placed;
    std::string label;
    ChangeOutcome outcome;
    std::vector<Swap> swaps;
    bool is_on_probation = false;
  };

  static std::vector<Swap> SwapsIn(const ChangeSet& changes, Runtime& runtime);
  static void Log(const State& state, ControlLog& log);
  static void Apply(State& state, const ControlledApplication& application);
  static void LookAfterProbation(State& state, const ControlledApplication& application);
  void Post(void (*what)(State&, const ControlledApplication&));

  const ControlledApplication& application_;
  ChangeWorker& worker_;
  const std::shared_ptr<State> state_;
  std::shared_ptr<ChangeWorker::Job> job_;
  bool has_looked_ = false;
  bool has_proved_ = false;
  Time until_{};
};

}  // namespace runnel
