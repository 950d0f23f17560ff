#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/element/framework_element.h"

namespace runnel {

/// Words that say something of an element to whoever looks at it: "safety", "hidden". The framework makes nothing
/// of them; viewers show them, and plugins may agree on some. A module that takes another one's place has its
/// tags, too, unless it brings some itself.
///
/// Threads: under the structure lock.

/// A word without blanks, as an element's name. Errors: what is none.
Result<void> CheckTags(const std::vector<std::string>& tags);
Result<void> SetTags(FrameworkElement& element, std::vector<std::string> tags);
/// In the order in which they were given.
[[nodiscard]] std::vector<std::string> TagsOf(const FrameworkElement& element);
[[nodiscard]] bool HasTag(const FrameworkElement& element, std::string_view tag);
/// Separated by blanks; "" for none.
[[nodiscard]] std::string TagsText(const FrameworkElement& element);
[[nodiscard]] std::vector<std::string> TagsInText(std::string_view text);

}  // namespace runnel
