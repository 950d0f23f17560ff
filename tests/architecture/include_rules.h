#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/architecture/source_tree.h"

namespace runnel::test {

/// Which files a rule is about, and which folders they may include from. A file falls under the
/// first rule whose pattern it matches.
struct IncludeRule {
  std::string name;                      ///< of the part that these files are, for messages and circles
  std::string files;                     ///< a folder, or the beginning of file names: "plugins/scheduling/xml_"
  std::vector<std::string> may_include;  ///< folders, with all below them; their own part besides
  bool is_algorithm = false;             ///< knows no framework: of <…>, only the standard, Eigen and fmt
};

/// The layers of the project, bottom to top.
[[nodiscard]] const std::vector<IncludeRule>& ProjectRules();

/// Each offence as "file:line: what is wrong": an include that the rules do not allow, that goes
/// into the internal folder of another library, that is not rooted at the tree root, or a file that
/// falls under no rule.
[[nodiscard]] std::vector<std::string> IncludeOffences(const SourceTree& tree, const std::vector<IncludeRule>& rules);

/// Circles among the parts of the rules, as the includes make them: "a > b > a".
[[nodiscard]] std::vector<std::string> Circles(const SourceTree& tree, const std::vector<IncludeRule>& rules);

}  // namespace runnel::test
