#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

/// What would take a change set back. Filled step by step while it is carried out, each step just before
/// it takes effect, so that what is noted is what was there.
struct Inverse {
  /// Of each step, in the order of the steps; those of one step in their own order.
  std::vector<ChangeSet> of_steps;
  /// What cannot be made again by a change, if there is something.
  std::optional<Error> why_not = {};

  /// All of it, the last step first.
  [[nodiscard]] ChangeSet All() const;
};

/// Makes the element again, with all that is below it, the values of parameters that are not the default
/// ones, its assignments to threads and its connections. Under the structure lock.
/// `why_not` is set if there is something that no change can make.
[[nodiscard]] ChangeSet MakeAgain(FrameworkElement& element, std::optional<Error>& why_not);

/// Puts a module like `before` in the place of `after`, with the values that it has now.
[[nodiscard]] ChangeSet ReplaceBack(const FrameworkElement& before, const FrameworkElement& after,
                                    std::uint64_t probation_cycles, std::optional<Error>& why_not);

/// The path of the thread container that the element itself is assigned to, or "".
[[nodiscard]] std::string OwnThreadPath(const FrameworkElement& element);

/// What `changes` would delete or replace, and what these elements are now: path and what it is. For
/// finding out whether others have put something else in their place. Under the structure lock.
using Expected = std::map<std::string, std::string>;
[[nodiscard]] Expected WhatIsThere(const ChangeSet& changes, FrameworkElement& root);

/// Whether `changes` still find what they are to delete or replace, and delete nothing that is not theirs.
/// Errors: what is not as it was. Under the structure lock.
Result<void> CheckExpected(const ChangeSet& changes, const Expected& expected,
                           FrameworkElement& root);

/// A change set that takes another one back.
struct UndoRecord {
  ChangeSet changes;
  Expected expected;
  std::optional<Error> why_not;  ///< it cannot be taken back
};

/// Right after the change set that `inverse` is of has been carried out. Under the structure lock.
[[nodiscard]] UndoRecord UndoRecordOf(Inverse inverse, FrameworkElement& root);

}  // namespace runnel::internal
