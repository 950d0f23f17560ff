#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <concepts>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

namespace runnel {

/// `text` in quotation marks, with what JSON wants escaped; bytes that are no UTF-8 become U+FFFD.
void AppendJsonString(std::string_view text, std::string& json);
/// In the fewest digits that read back the same; NaN is null, infinities are 1e999 and -1e999.
template <typename N>
requires std::is_arithmetic_v<N>
void AppendJsonNumber(N number, std::string& json) {
  if constexpr (std::floating_point<N>) {
    if (!std::isfinite(number)) {
      json += std::isnan(number) ? "null" : number > 0 ? "1e999" : "-1e999";
      return;
    }
  }
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  json.append(digits.data(), end.ptr);
}

namespace internal {

// A bracket now, and the other one at the end of life, which throws what appending throws. While another
// exception passes, the text is lost anyway and stays open: a second one would end the process.
class JsonBrackets {
 public:
  JsonBrackets(std::string& json, char opening, char closing) : json_(json), closing_(closing) { json_ += opening; }
  ~JsonBrackets() noexcept(false) {
    if (std::uncaught_exceptions() == exceptions_) json_ += closing_;
  }
  JsonBrackets(const JsonBrackets&) = delete;
  JsonBrackets& operator=(const JsonBrackets&) = delete;

 private:
  std::string& json_;
  const char closing_;
  const int exceptions_ = std::uncaught_exceptions();
};

}  // namespace internal

/// Writes one JSON object behind what is in `json`, which must not be written to otherwise but where
/// Key() says so. Closed by its end of life, which throws if there is no memory for it.
///
///     JsonObject object(json);
///     object.Add("op", "advertise");
///     JsonArray channels(object.Key("channels"));
class JsonObject {
 public:
  explicit JsonObject(std::string& json) : json_(json), brackets_(json, '{', '}') {}

  /// Whoever calls it writes the value next, whole.
  std::string& Key(std::string_view name) {
    if (!is_empty_) json_ += ',';
    is_empty_ = false;
    AppendJsonString(name, json_);
    json_ += ':';
    return json_;
  }
  JsonObject& Add(std::string_view name, std::string_view text) {
    AppendJsonString(text, Key(name));
    return *this;
  }
  JsonObject& Add(std::string_view name, const char* text) { return Add(name, std::string_view(text)); }
  template <typename N>
  requires std::is_arithmetic_v<N> JsonObject& Add(std::string_view name, N number) {
    if constexpr (std::same_as<N, bool>) {
      Key(name) += number ? "true" : "false";
    } else {
      AppendJsonNumber(number, Key(name));
    }
    return *this;
  }
  /// `json` is JSON.
  JsonObject& AddJson(std::string_view name, std::string_view json) {
    Key(name) += json;
    return *this;
  }
  /// null for nothing, and for "".
  template <typename N>
  JsonObject& AddOrNull(std::string_view name, const std::optional<N>& number) {
    return number ? Add(name, *number) : AddJson(name, "null");
  }
  JsonObject& AddTextOrNull(std::string_view name, std::string_view text) {
    return text.empty() ? AddJson(name, "null") : Add(name, text);
  }

 private:
  std::string& json_;
  const internal::JsonBrackets brackets_;
  bool is_empty_ = true;
};

/// The same for a list.
class JsonArray {
 public:
  explicit JsonArray(std::string& json) : json_(json), brackets_(json, '[', ']') {}

  /// Whoever calls it writes the element next, whole.
  std::string& Next() {
    if (!is_empty_) json_ += ',';
    is_empty_ = false;
    return json_;
  }
  void Add(std::string_view text) { AppendJsonString(text, Next()); }

 private:
  std::string& json_;
  const internal::JsonBrackets brackets_;
  bool is_empty_ = true;
};

/// A list of what `append(item, json)` writes for each.
template <typename Items, typename Append>
void AppendList(const Items& items, std::string& json, const Append& append) {
  JsonArray list(json);
  for (const auto& item : items) append(item, list.Next());
}

/// The object that `fill` has filled.
template <typename Fill>
[[nodiscard]] std::string JsonObjectText(const Fill& fill) {
  std::string json;
  {
    JsonObject object(json);
    fill(object);
  }
  return json;
}

}  // namespace runnel
