#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "plugins/structure/change.h"

namespace runnel {

/// Changes as text, one a line or separated by ';', for terminals, files and rules:
///
///     create /robot/filter sensors/scan_filter window=5
///     create group /robot/left
///     create port /robot/left/scan input RangeScan description="of the front laser"
///     create parameter /robot/radius left/radius right/radius    # sets both
///     delete /robot/filter
///     connect /laser/scan /robot/filter/scan queue=10 on_full=refuse
///     connect /camera/image /robot/filter/image pull=true
///     disconnect /laser/scan /robot/planner/scan
///     set /robot/base/target {x: 1, y: 2}
///     replace /robot/planner with planning/tangent_bug step=0.1 probation=10
///     rename /robot/planner old_planner
///     copy /robot/planner                           # as planner_2; or: copy /robot/planner second
///     move /robot/planner to control
///     move /robot/planner to ""                     # back to where its group is run
///     create thread fast period=5ms priority=20     # activation=trigger, free_running; on_overrun=catch_up
///     schedule fast period=2ms                      # delete /threads/fast
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
