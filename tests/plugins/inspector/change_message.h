#pragma once

#include <string>
#include <type_traits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plugins/structure/change_fields.h"
#include "plugins/structure/change_text.h"

namespace runnel::test {

using Json = nlohmann::json;

inline Json JsonOf(const FieldValue& value) {
  return std::visit(
      [](const auto& said) -> Json {
        using T = std::remove_cvref_t<decltype(said)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<T, Duration>) {
          return ToSeconds(said);
        } else if constexpr (std::is_same_v<T, std::vector<Setting>>) {
          Json json = Json::object();
          for (const auto& [parameter, text] : said) json[parameter] = text;
          return json;
        } else {
          return said;
        }
      },
      value);
}

/// As the protocol has it, with what is not usual.
inline Json MessageOf(const Change& change) {
  const ChangeForm& form = *FormOf(change);
  const Change usual = form.make();
  Json json{{"change", form.name}};
  for (const FieldForm& field : form.fields) {
    const FieldValue value = field.get(change);
    if (!field.is_option() || value != field.get(usual)) json[field.name] = JsonOf(value);
  }
  return json;
}

/// A change in its text format, which is shorter to write, as the protocol has it.
inline Json ChangeMessage(const std::string& text) {
  Diagnostics diagnostics;
  const PlacedChanges placed = ParseChanges(text, {}, diagnostics);
  if (diagnostics.ok() && placed.changes.size() == 1) return MessageOf(placed.changes.front());
  ADD_FAILURE() << "no change: " << text;
  return {};
}

}  // namespace runnel::test
