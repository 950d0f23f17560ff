#pragma once

#include <cstddef>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "plugins/structure/inverse.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {

/// Carries out change sets and takes them back: undo and redo. One for an application, shared by all who
/// change it for a person: terminals, browsers.
///
/// What would take a change set back is noted while it is carried out: deleted modules are made anew by
/// their types, with the values that their parameters had and connections with their queues; what flowed or
/// was remembered in them is gone, and they come last among their siblings and among the connections of a
/// port. Taking back is a change set like any other: all of it or nothing, between two cycles.
///
/// Others, who change the structure past the history, do not disturb it as long as what it wants to change
/// is still there as it was. Else an Undo() or Redo() is refused with what stands against it, nothing has
/// happened, and that one entry is forgotten.
///
/// Ownership:  the editor must outlive it.
/// Threads:    as StructureEditor; NextUndo() and NextRedo() wait for nobody's change.
class ChangeHistory {
 public:
  static constexpr std::size_t kMostEntries = 100;

  explicit ChangeHistory(StructureEditor& editor, std::size_t most_entries = kMostEntries)
      : editor_(editor), most_entries_(most_entries) {}

  /// As StructureEditor::Apply(); what is done can be undone, and nothing be redone any more. `label` is
  /// what people read of it; "": the change in its text format, and how many more there are. `client`: who
  /// wants it, for people.
  ChangeOutcome Apply(const ChangeSet& changes, const std::vector<SourcePosition>& places = {}, std::string label = {},
                      std::string client = {}, const RobotStop::AsOf& as_of = {});
  /// Takes back what was done last. Errors: nothing to undo; what makes it impossible.
  ChangeOutcome Undo(const RobotStop::AsOf& as_of = {}) { return Take(done_, undone_, "undone", as_of); }
  /// Does again what was undone last: what takes back what took back is what was done.
  ChangeOutcome Redo(const RobotStop::AsOf& as_of = {}) { return Take(undone_, done_, "redone", as_of); }

  /// What Undo() would take back, and Redo() do again; nullopt: nothing.
  [[nodiscard]] std::optional<std::string> NextUndo() const { return LastOf(done_, &Entry::label); }
  [[nodiscard]] std::optional<std::string> NextRedo() const { return LastOf(undone_, &Entry::label); }
  /// Who wanted that; "": nothing, or nobody has said so.
  [[nodiscard]] std::string UndoClient() const { return LastOf(done_, &Entry::client).value_or(""); }
  [[nodiscard]] std::string RedoClient() const { return LastOf(undone_, &Entry::client).value_or(""); }

 private:
  struct Entry {
    std::string label;
    std::string client;
    internal::UndoRecord undo_record;  // back
  };
  using Entries = std::list<Entry>;  // whose entries go from one to the other without memory

  ChangeOutcome Take(Entries& from, Entries& to, const char* what, const RobotStop::AsOf& as_of);
  void Add(Entries& to, Entries& entry);
  [[nodiscard]] std::optional<std::string> LastOf(const Entries& entries, std::string Entry::*part) const;

  StructureEditor& editor_;
  const std::size_t most_entries_;
  std::mutex applying_;         // so that entries are in the order of the changes; before all others
  mutable std::mutex entries_;  // a leaf
  Entries done_;                // guarded by entries_
  Entries undone_;              // guarded by entries_
};

}  // namespace runnel
