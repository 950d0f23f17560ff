#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace runnel::internal {

/// `text` in quotation marks. What is no UTF-8 becomes U+FFFD: a browser would refuse the message.
void AppendQuoted(std::string_view text, std::string& json);
/// The shortest form that reads back to the same; null if it is not finite.
void AppendNumber(double number, std::string& json);

/// Writes "{…}" member by member to the end of a text; the bracket is closed with its life.
class JsonObject {
 public:
  explicit JsonObject(std::string& json) : json_(json) { json_ += '{'; }
  ~JsonObject() { json_ += '}'; }
  JsonObject(const JsonObject&) = delete;
  JsonObject& operator=(const JsonObject&) = delete;

  JsonObject& Text(std::string_view key, std::string_view text) {
    AppendQuoted(text, Key(key));
    return *this;
  }
  JsonObject& Number(std::string_view key, double number) {
    AppendNumber(number, Key(key));
    return *this;
  }
  JsonObject& Whole(std::string_view key, std::uint64_t number) {
    Key(key) += std::to_string(number);
    return *this;
  }
  JsonObject& Flag(std::string_view key, bool flag) {
    Key(key) += flag ? "true" : "false";
    return *this;
  }
  JsonObject& Null(std::string_view key) {
    Key(key) += "null";
    return *this;
  }
  /// null for "".
  JsonObject& TextOrNull(std::string_view key, std::string_view text) {
    return text.empty() ? Null(key) : Text(key, text);
  }
  JsonObject& NumberOrNull(std::string_view key, std::optional<double> number) {
    return number ? Number(key, *number) : Null(key);
  }
  /// `json` as it is.
  JsonObject& Json(std::string_view key, std::string_view json) {
    Key(key) += json;
    return *this;
  }
  /// Writes the key; the value is to be appended.
  std::string& Key(std::string_view key) {
    if (!is_first_) json_ += ',';
    is_first_ = false;
    json_ += '"';
    json_ += key;
    json_ += "\":";
    return json_;
  }

 private:
  std::string& json_;
  bool is_first_ = true;
};

/// "[a,b,c]" of what `append(item, json)` writes for each.
template <typename Items, typename Append>
void AppendList(const Items& items, std::string& json, const Append& append) {
  json += '[';
  bool is_first = true;
  for (const auto& item : items) {
    if (!is_first) json += ',';
    is_first = false;
    append(item, json);
  }
  json += ']';
}

}  // namespace runnel::internal
