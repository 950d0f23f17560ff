#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/base/error.h"
#include "plugins/structure/change.h"

namespace runnel {

/// Changes as text, one a line or separated by ';', for terminals, files and rules; change_fields.h has an example of each:
///
///     create /robot/filter sensors/scan_filter window=5
///     connect /laser/scan /robot/filter/scan queue=10 on_full=refuse
///     set /robot/base/target {x: 1, y: 2}
///     move /robot/planner to ""                     # back to where its group is run
///
/// Arguments are separated by whitespace. What has whitespace or a ';' in it stands in quotation marks, in which
/// the escapes are those of C++ (\" and \\, \n, \t, \r); a value in brackets, as the text format of
/// types has them, needs none. '#' at the start of an argument begins a comment.
/// `probation` is of the replacement: a parameter of that name is set by a `set` after it.

/// Changes with the places in the user's text at which they stand.
struct PlacedChanges {
  ChangeSet changes;
  std::vector<SourcePosition> positions;  ///< as many as changes
};

/// Reads changes; `begins` is where the text begins: its file, line and column (0: the first). All
/// that is wrong goes to `diagnostics`, with line, column and the nearest word; the changes that are
/// right are returned nevertheless.
///
/// Only the text is looked at, not whether an application could be changed like that: Apply() does.
[[nodiscard]] PlacedChanges ParseChanges(std::string_view text, const SourcePosition& begins, Diagnostics& diagnostics);

/// The change as ParseChanges() reads it.
[[nodiscard]] std::string ChangeText(const Change& change);

}  // namespace runnel
