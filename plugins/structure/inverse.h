#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "plugins/structure/change.h"

namespace runnel {
class ThreadContainer;
}

namespace runnel::internal {

// What would take a change set back is noted step by step while it is carried out, each step just before it takes
// effect, so that what is noted is what was there.

/// Makes the element again, with all that is below it, the values of parameters that are not the default
/// ones, its assignments to threads and its connections. Under the structure lock.
/// `why_not` is set if there is something that no change can make.
[[nodiscard]] ChangeSet MakeAgain(FrameworkElement& element, std::optional<Error>& why_not);

/// Makes another one like it at `path`: the same, but for connections with others. All paths are absolute.
[[nodiscard]] ChangeSet MakeLike(FrameworkElement& element, const std::string& path, std::optional<Error>& why_not);

/// The same for a thread, with what is assigned to it.
void AddThreadAgain(const ThreadContainer& thread, ChangeSet& changes);

/// Puts a module like `before` in the place of `after`, with the values that it has now.
[[nodiscard]] ChangeSet ReplaceBack(const FrameworkElement& before, const FrameworkElement& after,
                                    const ReplaceModule& change, std::optional<Error>& why_not);

/// The path of the thread container that the element itself is assigned to, or "".
[[nodiscard]] std::string OwnThreadPath(const FrameworkElement& element);

/// A change set that takes another one back.
struct UndoRecord {
  ChangeSet changes;
  /// What `changes` would delete or replace, and what these elements were then: path and what it is. For
  /// finding out whether others have put something else in their place.
  std::map<std::string, std::string> expected;
  std::optional<Error> why_not;  ///< it cannot be taken back: what no change can make again
};

/// Right after the change set has been carried out that `inverses` are of, step by step. Under the structure lock.
[[nodiscard]] UndoRecord UndoRecordOf(const std::vector<ChangeSet>& inverses, std::optional<Error> why_not,
                                      FrameworkElement& root);

/// Whether its changes still find what they are to delete or replace, and delete nothing that is not theirs.
/// Errors: what is not as it was. Under the structure lock.
Result<void> CheckExpected(const UndoRecord& undo_record, FrameworkElement& root);

}  // namespace runnel::internal
