#include "plugins/runtime_construction/attribute_rule.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/xml/xml_reading.h"

namespace runnel {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr double kLongestDuration = 9.2e9;  // s; more does not fit into nanoseconds

std::string Quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

template <typename T>
Result<void> WithoutValue(const Result<T>& result) {
  if (!result) return result.error();
  return {};
}

Result<void> CheckNotEmpty(std::string_view value) {
  if (SplitBlanks(value).empty()) return Error{.message = "a path must not be empty"};
  return {};
}

Result<void> CheckSinglePath(std::string_view value) {
  if (auto filled = CheckNotEmpty(value); !filled) return filled;
  if (kBlanks.find(value.front()) != std::string_view::npos ||
      kBlanks.find(value.back()) != std::string_view::npos) {
    return Error{.message = "the path " + Quoted(value) + " begins or ends with a blank"};
  }
  return {};
}

Result<void> CheckNumber(std::string_view value) {
  if (ParseNumber(value)) return {};
  return Error{.message = Quoted(value) + " is not a number"};
}

Result<void> CheckChoice(const AttributeRule& rule, std::string_view value) {
  if (std::ranges::find(rule.choices, value) != rule.choices.end()) return {};
  return Error{.message = Quoted(value) + " is not possible for " + rule.name,
               .hint = NearestNameHint(value, rule.choices)};
}

}  // namespace

Result<void> CheckAttributeValue(const AttributeRule& rule, std::string_view value) {
  switch (rule.kind) {
    case AttributeKind::kText:
      return {};
    case AttributeKind::kName:
      return CheckElementName(value);
    case AttributeKind::kPath:
      return CheckSinglePath(value);
    case AttributeKind::kPathList:
      return CheckNotEmpty(value);
    case AttributeKind::kCount:
      return WithoutValue(ParseCount(value));
    case AttributeKind::kNumber:
      return CheckNumber(value);
    case AttributeKind::kFlag:
      return WithoutValue(ParseFlag(value));
    case AttributeKind::kDuration:
      return WithoutValue(ParseDuration(value));
    case AttributeKind::kChoice:
      return CheckChoice(rule, value);
  }
  return {};
}

Result<std::size_t> ParseCount(std::string_view text) {
  std::size_t count = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (problem != std::errc{} || end != text.data() + text.size()) {
    return Error{.message = Quoted(text) + " is not a count", .hint = "write 0, 1, 2 …"};
  }
  return count;
}

Result<bool> ParseFlag(std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  return Error{.message = Quoted(text) + " is neither true nor false"};
}

Result<Duration> ParseDuration(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
      {{"ns", 1e-9}, {"us", 1e-6}, {"ms", 1e-3}, {"min", 60.0}, {"s", 1.0}}};
  for (const auto& [unit, seconds] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto number = ParseNumber(text.substr(0, text.size() - unit.size()));
    if (!number || *number * seconds > kLongestDuration) break;
    const Duration duration = FromSeconds(*number * seconds);
    if (duration <= Duration::zero()) {
      return Error{.message = Quoted(text) + " is not longer than nothing"};
    }
    return duration;
  }
  return Error{.message = Quoted(text) + " is not a duration",
               .hint = "write a number and its unit (ns, us, ms, s, min), like '50ms'"};
}

std::vector<std::string> SplitBlanks(std::string_view text) {
  std::vector<std::string> words;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.emplace_back(text.substr(begin, end - begin));
    text.remove_prefix(end);
  }
}

}  // namespace runnel
