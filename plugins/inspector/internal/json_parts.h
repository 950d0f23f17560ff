#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "plugins/json_values/json_writer.h"

namespace runnel::internal {

inline void AddNull(std::string_view key, JsonObject& json) { json.AddJson(key, "null"); }

/// null for "".
inline void AddTextOrNull(std::string_view key, std::string_view text, JsonObject& json) {
  if (text.empty()) return AddNull(key, json);
  json.Add(key, text);
}

template <typename Number>
void AddNumberOrNull(std::string_view key, const std::optional<Number>& number, JsonObject& json) {
  if (!number) return AddNull(key, json);
  json.Add(key, *number);
}

/// "[a,b,c]" of what `append(item, json)` writes for each.
template <typename Items, typename Append>
void AppendList(const Items& items, std::string& json, const Append& append) {
  JsonArray list(json);
  for (const auto& item : items) append(item, list.Next());
}

}  // namespace runnel::internal
