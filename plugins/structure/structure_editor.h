#pragma once

#include <memory>
#include <vector>

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change.h"

namespace runnel {

namespace internal {
struct UndoRecord;
class Workshop;
}  // namespace internal

/// What has become of a change set.
struct ChangeOutcome {
  bool is_done = false;     ///< else nothing has changed
  bool is_refused = false;  ///< not done as the structure is not such that it could be
  Diagnostics diagnostics;  ///< why not; warnings also of what has been done
  Duration hold_time{};     ///< how long the threads concerned have been kept between two cycles

  explicit operator bool() const noexcept { return is_done; }
  /// The first of the errors, for who can tell only one.
  [[nodiscard]] Result<void> ToResult() const {
    if (is_done) return {};
    if (diagnostics.ok()) return Error{.message = "out of memory"};  // not even what is wrong could be said
    return diagnostics.errors().front();
  }
};

struct EditorOptions {
  /// How long to wait for threads to come to the end of their cycles before giving up.
  Duration timeout = std::chrono::seconds(5);
};

/// Changes the structure of a running application. A change set is checked as a whole and what is new is
/// made, configured and prepared beside the tree, while everything runs: modules without the structure lock, so that a
/// slow constructor keeps nobody waiting. Then the threads concerned are
/// kept between two of their cycles for as long as it takes to put the new in its place. If anything is
/// wrong, nothing has happened.
///
/// Ownership:  runtime, registry and scheduler must outlive it.
/// Threads:    any, but not from within a cycle, nor under the structure lock. Change sets of several
///             threads take effect one after the other.
/// Allocation: yes. Cycles allocate nothing for it.
/// Errors:     in the outcome, all of them at once.
class StructureEditor {
 public:
  /// Without a scheduler nobody may run the modules concerned while a change set is applied.
  StructureEditor(Runtime& runtime, const ModuleRegistry& modules, Scheduler* scheduler, EditorOptions options = {});
  ~StructureEditor();
  StructureEditor(const StructureEditor&) = delete;
  StructureEditor& operator=(const StructureEditor&) = delete;

  /// `places` are those of the changes in a user's text, for the errors. `as_of`: when somebody asked for it; if STOP was
  /// pressed or released since, and be it while new modules are made, nothing is done. `back` gets what takes them back.
  ChangeOutcome Apply(const ChangeSet& changes, const std::vector<SourcePosition>& places = {},
                      const RobotStop::AsOf& as_of = {}, ChangeSet* back = nullptr);

  /// Lets go of replaced modules whose successors have proved themselves. Apply() does it too; call it
  /// now and then to have their memory back earlier.
  void Tend();
  /// How many replaced modules still wait for their successors to prove themselves.
  [[nodiscard]] std::size_t on_probation() const;

 private:
  friend class ChangeHistory;
  struct Shared;
  enum class Attempt { kDone, kFailed, kOvertaken };

  /// What is to be done, and what is to be known of it besides.
  struct ChangeRequest {
    const ChangeSet& changes;
    const std::vector<SourcePosition>& places;
    const RobotStop::AsOf& as_of;
    const internal::UndoRecord* undo_record = nullptr;  // that `changes` are of
    internal::UndoRecord* back = nullptr;               // is to be filled
  };
  ChangeOutcome Apply(const ChangeRequest& request);
  Attempt Try(const ChangeRequest& request, internal::Workshop& workshop, ChangeOutcome& outcome);

  Runtime& runtime_;
  const ModuleRegistry& modules_;
  Scheduler* const scheduler_;
  const EditorOptions options_;
  const std::shared_ptr<Shared> shared_;
};

}  // namespace runnel
