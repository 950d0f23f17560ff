#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// What may stand in an attribute of an application file.
enum class AttributeKind {
  kText,        ///< anything
  kName,        ///< what can name an element (core/element/element_path.h)
  kNewName,     ///< the same, of the element that the tag makes
  kPath,        ///< one path, not empty
  kPathList,    ///< paths separated by blanks, at least one
  kCount,       ///< 0, 1, 2 …
  kNumber,      ///< finite
  kDuration,    ///< longer than nothing, with unit: "50ms"
  kChoice,      ///< one of AttributeRule::choices
  kModuleType,  ///< that a plugin has brought
  kPortType,    ///< of values, that something in the program or in a plugin uses
};

/// One attribute that a tag understands.
struct AttributeRule {
  std::string name;
  AttributeKind kind = AttributeKind::kText;
  bool required = false;
  std::string summary = {};  ///< one line, told to those who have left out what is required
  std::vector<std::string> choices = {};
  /// Paths in it lead to elements of the tree: a tag whose path leads nowhere any more means
  /// nothing, and is left out when the application is saved.
  bool names_element = false;
};

/// Whether `value` may stand in the attribute, as far as its form goes; the error says what may.
Result<void> CheckAttributeValue(const AttributeRule& rule, std::string_view value);

/// The values of attributes, for those who handle tags (durations: core/types/duration_text.h).
/// Errors say what is wrong, without a place.
Result<std::size_t> ParseCount(std::string_view text);
/// The words of a list of paths. Commas separate as well, so that more can be said of a list that
/// has them by mistake; as a value it is refused.
[[nodiscard]] std::vector<std::string> SplitPaths(std::string_view text);

}  // namespace runnel
