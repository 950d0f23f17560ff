#include "plugins/application_files/attribute_rule.h"

#include <algorithm>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/element/element_path.h"
#include "core/types/duration_text.h"
#include "core/xml/xml_reading.h"

namespace runnel {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kSeparators = " \t\r\n,";

std::string InApostrophes(std::string_view text) { return "'" + std::string(text) + "'"; }

Result<void> CheckNotEmpty(std::string_view value) {
  if (SplitPaths(value).empty()) return Error{.message = "a path must not be empty"};
  return {};
}

Result<void> CheckSinglePath(std::string_view value) {
  if (auto filled = CheckNotEmpty(value); !filled) return filled;
  if (kBlanks.find(value.front()) != std::string_view::npos ||
      kBlanks.find(value.back()) != std::string_view::npos) {
    return Error{.message = "the path " + InApostrophes(value) + " begins or ends with a blank"};
  }
  return {};
}

Result<void> CheckPathList(std::string_view value) {
  if (auto filled = CheckNotEmpty(value); !filled) return filled;
  if (value.find(',') == std::string_view::npos) return {};
  return Error{.message = "a comma between paths", .hint = "paths are separated by blanks"};
}

Result<void> CheckNumber(std::string_view value) {
  if (ParseNumber(value)) return {};
  return Error{.message = InApostrophes(value) + " is not a number"};
}

Result<void> CheckDuration(std::string_view value) {
  const auto duration = ParseDuration(value);
  if (!duration) return duration.error();
  if (*duration > Duration::zero()) return {};
  return Error{.message = InApostrophes(value) + " is not longer than nothing"};
}

Result<void> CheckChoice(const AttributeRule& rule, std::string_view value) {
  if (std::ranges::find(rule.choices, value) != rule.choices.end()) return {};
  return Error{.message = InApostrophes(value) + " is not possible for " + rule.name,
               .hint = NearestNameHint(value, rule.choices)};
}

}  // namespace

Result<void> CheckAttributeValue(const AttributeRule& rule, std::string_view value) {
  switch (rule.kind) {
    case AttributeKind::kText:
    case AttributeKind::kModuleType:
    case AttributeKind::kPortType:
      return {};
    case AttributeKind::kName:
    case AttributeKind::kNewName:
      return CheckElementName(value);
    case AttributeKind::kPath:
      return CheckSinglePath(value);
    case AttributeKind::kPathList:
      return CheckPathList(value);
    case AttributeKind::kCount:
      if (auto count = ParseCount(value); !count) return count.error();
      return {};
    case AttributeKind::kNumber:
      return CheckNumber(value);
    case AttributeKind::kDuration:
      return CheckDuration(value);
    case AttributeKind::kChoice:
      return CheckChoice(rule, value);
  }
  return {};
}

Result<std::size_t> ParseCount(std::string_view text) {
  if (const auto count = NumberIn<std::size_t>(text)) return *count;
  return Error{.message = InApostrophes(text) + " is not a count", .hint = "write 0, 1, 2 …"};
}

std::vector<std::string> SplitPaths(std::string_view text) {
  std::vector<std::string> words;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kSeparators);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(text.find_first_of(kSeparators, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

}  // namespace runnel
