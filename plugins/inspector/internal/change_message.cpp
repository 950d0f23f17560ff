// Changes as PROTOCOL.md has them, by their fields.

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/tags.h"
#include "plugins/inspector/internal/viewer_message.h"
#include "plugins/structure/change_fields.h"

namespace runnel::internal {

namespace {

using FieldKind = FieldForm::Kind;

template <typename T>
FieldValue ValueOf(std::optional<T> said) {
  return said ? FieldValue(std::move(*said)) : FieldValue();
}

// A list of texts, or one with blanks between them.
FieldValue TextsIn(JsonMembers& members, const std::string& name) {
  const JsonPart* const found = members.Find(name);
  if (found == nullptr || found->is_null()) return {};
  if (const auto text = found->text()) return TagsInText(*text);
  return members.NeedTexts(name);
}

// {"step": "0.1"}: values of parameters in their text format.
FieldValue SettingsIn(JsonMembers& members, const std::string& name) {
  const JsonPart* const found = members.Find(name);
  if (found == nullptr) return {};
  if (!found->is_object()) members.Complain("\"" + name + "\" must be an object");
  std::vector<Setting> settings;
  for (const auto& [parameter, value] : found->members()) {
    auto text = value.text();
    if (!text) members.Complain("the setting '" + parameter + "' must be a text");
    settings.push_back({parameter, std::move(text).value_or("")});
  }
  return settings;
}

FieldValue WordIn(JsonMembers& members, const FieldForm& field) {
  const auto word = members.Text(field.name);
  if (word && !field.words.empty() && std::ranges::count(field.words, *word) == 0) {
    members.Complain("\"" + field.name + "\" cannot be '" + *word + "'", NearestNameHint(*word, field.words));
    return {};
  }
  return ValueOf(word);
}

FieldValue ValueIn(JsonMembers& members, const FieldForm& field) {
  switch (field.kind) {
    case FieldKind::kText:
    case FieldKind::kValue:
      return WordIn(members, field);
    case FieldKind::kFlag:
      return ValueOf(members.Flag(field.name));
    case FieldKind::kCount:
      return ValueOf(members.Count(field.name, field.most));
    case FieldKind::kNumber:
    case FieldKind::kDuration: {
      const auto seconds = members.Number(field.name);
      return seconds ? FieldValue(FromSeconds(*seconds)) : FieldValue();
    }
    case FieldKind::kTexts:
      return TextsIn(members, field.name);
    case FieldKind::kSettings:
      return SettingsIn(members, field.name);
  }
  return {};
}

}  // namespace

Result<Change> ParseChange(const JsonPart& json) {
  if (!json.is_object()) return Error{.message = "a change must be an object"};
  JsonMembers members(json);
  const JsonPart* const named = members.Find("change");
  const auto name = named != nullptr ? named->text() : std::nullopt;
  if (!name) return Error{.message = "\"change\" must be a text that says what to do"};
  const auto form = FindChangeForm(*name);
  if (!form) return form.error();
  Change change = (*form)->make();
  std::vector<std::string> said;
  for (const FieldForm& field : (*form)->fields) {
    FieldValue value = ValueIn(members, field);
    if (value == FieldValue()) {
      if (field.place == FieldForm::Place::kWord) members.Complain("\"" + field.name + "\" is missing");
    } else if (!members.error()) {
      said.push_back(field.name);
      field.set(change, std::move(value));
    }
  }
  members.RefuseOthers();
  const auto is_said = [&](std::string_view field) { return std::ranges::count(said, field) > 0; };
  auto conflict = members.error() || !(*form)->check ? std::nullopt : (*form)->check(change, is_said);
  if (conflict) members.Complain(std::move(conflict->second.message), std::move(conflict->second.hint));
  if (!members.error()) return change;
  return members.error()->WithContext("'" + *name + "'");
}

}  // namespace runnel::internal
