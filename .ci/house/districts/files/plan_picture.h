#pragma once

#include <string>
#include <vector>

#include "tests/architecture/include_rules.h"

namespace runnel::test {

/// The districts of `plugins` as `rules` have them: on which floor each stands, and on which others; what those stand on
/// is not said again. The text between the marks in plugins/README.md.
[[nodiscard]] std::string PlanPicture(const std::vector<IncludeRule>& rules);

/// "execution" for "plugins/execution/scheduling", "" for what is not below `plugins`.
[[nodiscard]] std::string DistrictOf(std::string_view file);

}  // namespace runnel::test
