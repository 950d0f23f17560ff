#include "plugins/values/json_reader.h"

#include <algorithm>
#include <cmath>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/values/internal/json_number.h"

namespace runnel {

std::optional<bool> JsonPart::boolean() const {
  if (IsWord("true")) return true;
  return IsWord("false") ? std::optional(false) : std::nullopt;
}

std::optional<std::string> JsonPart::text() const {
  return Is(ValueToken::Kind::kText) ? std::optional(token_->text) : std::nullopt;
}

std::optional<double> JsonPart::number() const { return internal::NumberOf<double>(*token_); }

std::optional<std::uint64_t> JsonPart::count() const {
  return Is(ValueToken::Kind::kWord) ? NumberIn<std::uint64_t>(token_->text) : std::nullopt;
}

std::vector<JsonPart> JsonPart::items() const {
  std::vector<JsonPart> items;
  if (!is_list()) return items;
  const ValueToken* item = token_->First();
  for (; items.size() < token_->count; item = item->Next()) items.push_back(Part(item));
  return items;
}

std::vector<std::pair<std::string, JsonPart>> JsonPart::members() const {
  std::vector<std::pair<std::string, JsonPart>> members;
  if (!is_object()) return members;
  const ValueToken* name = token_->First();
  for (; members.size() * 2 < token_->count; name = name->Next()->Next()) {
    members.emplace_back(name->text, Part(name->Next()));
  }
  return members;
}

const JsonPart* JsonMembers::Find(const std::string& name) {
  known_.push_back(name);
  const auto found =
      std::ranges::find(members_, name, [](const auto& each) -> const std::string& { return each.first; });
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

std::optional<bool> JsonMembers::Flag(const std::string& name) {
  return Take(name, "true or false", [](const JsonPart& part) { return part.boolean(); });
}

std::optional<std::vector<JsonPart>> JsonMembers::List(const std::string& name) {
  return Take(name, "a list",
              [](const JsonPart& part) { return part.is_list() ? std::optional(part.items()) : std::nullopt; });
}

std::vector<std::string> JsonMembers::NeedTexts(const std::string& name) {
  std::vector<std::string> texts;
  for (const JsonPart& each : NeedList(name)) {
    auto text = each.text();
    if (!text) Complain("\"" + name + "\" must be a list of texts");
    texts.push_back(std::move(text).value_or(""));
  }
  return texts;
}

void JsonMembers::RefuseOthers() {
  const std::vector<std::string> known = known_;
  for (const auto& [name, value] : members_) {
    if (std::ranges::find(known, name) != known.end()) continue;
    return Complain("has no \"" + name + "\"", NearestNameHint(name, known));
  }
}

}  // namespace runnel
