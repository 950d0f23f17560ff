#include "plugins/values/json_reader.h"

#include <algorithm>
#include <cmath>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/values/internal/json_cursor.h"

namespace runnel {

Result<JsonPart> JsonPart::Parse(std::string_view text, int deepest) {
  JsonCursor cursor(text);
  if (!cursor.SkipValue(deepest)) {
    if (cursor.is_too_deep()) return cursor.ErrorAt(cursor.place(), "it is nested too deeply");
    cursor.SkipWhitespace();
    return cursor.ExpectedAt(cursor.place(), "JSON");
  }
  if (!cursor.AtEnd()) return cursor.ExpectedAt(cursor.place(), "the end");
  return JsonPart(JsonCursor(text).TakeValue());
}

std::optional<std::string> JsonPart::text() const {
  JsonCursor cursor(json_);
  std::string text;
  if (!json_.starts_with('"')) return {};
  cursor.TakeString(text);
  return text;
}

std::optional<double> JsonPart::number() const {
  const std::string_view digits = JsonCursor(json_).TakeNumber();
  if (digits.empty()) return {};
  return DoubleOf(digits);
}

std::optional<std::uint64_t> JsonPart::count() const { return NumberIn<std::uint64_t>(json_); }

std::vector<JsonPart> JsonPart::items() const {
  std::vector<JsonPart> items;
  JsonCursor cursor(json_);
  if (!cursor.Skip('[') || cursor.Skip(']')) return items;
  do {
    items.push_back(JsonPart(cursor.TakeValue()));
  } while (cursor.Skip(','));
  return items;
}

std::vector<std::pair<std::string, JsonPart>> JsonPart::members() const {
  std::vector<std::pair<std::string, JsonPart>> members;
  JsonCursor cursor(json_);
  if (!cursor.Skip('{') || cursor.Skip('}')) return members;
  do {
    std::string name;
    cursor.TakeString(name);  // has been checked
    cursor.Skip(':');
    members.emplace_back(std::move(name), JsonPart(cursor.TakeValue()));
  } while (cursor.Skip(','));
  return members;
}

const JsonPart* JsonMembers::Find(const std::string& name) {
  known_.push_back(name);
  const auto found = std::ranges::find(
      members_, name, [](const auto& each) -> const std::string& { return each.first; });
  return found == members_.end() ? nullptr : &found->second;
}

template <typename Get>
auto JsonMembers::Take(const std::string& name, const std::string& what, const Get& get)
    -> decltype(get(std::declval<const JsonPart&>())) {
  const JsonPart* const found = Find(name);
  if (found == nullptr || found->is_null()) return {};
  auto value = get(*found);
  if (!value) Complain("\"" + name + "\" must be " + what);
  return value;
}

std::optional<std::string> JsonMembers::Text(const std::string& name) {
  return Take(name, "a text", [](const JsonPart& part) { return part.text(); });
}

std::optional<double> JsonMembers::Number(const std::string& name) {
  return Take(name, "a number, not below 0", [](const JsonPart& part) {
    const auto number = part.number();
    return number && std::isfinite(*number) && *number >= 0 ? number : std::nullopt;
  });
}

std::optional<std::uint64_t> JsonMembers::Count(const std::string& name, std::uint64_t most) {
  return Take(name, "a count, at most " + std::to_string(most), [most](const JsonPart& part) {
    const auto count = part.count();
    return count && *count <= most ? count : std::nullopt;
  });
}

std::optional<std::vector<JsonPart>> JsonMembers::List(const std::string& name) {
  return Take(name, "a list", [](const JsonPart& part) {
    return part.is_list() ? std::optional(part.items()) : std::nullopt;
  });
}

void JsonMembers::RefuseOthers() {
  const std::vector<std::string> known = known_;
  for (const auto& [name, value] : members_) {
    if (std::ranges::find(known, name) != known.end()) continue;
    return Complain("has no \"" + name + "\"", NearestNameHint(name, known));
  }
}

}  // namespace runnel
