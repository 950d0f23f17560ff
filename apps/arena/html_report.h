#pragma once

#include <string>
#include <vector>

#include "apps/arena/table.h"

namespace runnel::arena {

/// A page of its own, which needs nothing from elsewhere: a summary of the variants, all paths over
/// their worlds as small pictures, and a table of all runs that can be sorted by any column. For
/// light and dark surroundings.
[[nodiscard]] std::string HtmlReport(const Matrix& matrix, const std::vector<RunRecord>& records,
                                     const RunSettings& settings);

}  // namespace runnel::arena
