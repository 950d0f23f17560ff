#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <string>
#include <string_view>

namespace runnel {

/// `text` in quotation marks, with what JSON wants escaped; bytes that are no UTF-8 become U+FFFD.
void AppendJsonString(std::string_view text, std::string& json);
/// In the fewest digits that read back the same; NaN is null, infinities are 1e999 and -1e999.
void AppendJsonNumber(double number, std::string& json);
void AppendJsonNumber(float number, std::string& json);
void AppendJsonNumber(std::int64_t number, std::string& json);
void AppendJsonNumber(std::uint64_t number, std::string& json);

namespace internal {

// A bracket now, and the other one at the end of life, which throws what appending throws. While another
// exception passes, the text is lost anyway and stays open: a second one would end the process.
class JsonBrackets {
 public:
  JsonBrackets(std::string& json, char opening, char closing) : json_(json), closing_(closing) {
    json_ += opening;
  }
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
  void Add(std::string_view name, std::string_view text) { AppendJsonString(text, Key(name)); }
  void Add(std::string_view name, const char* text) { Add(name, std::string_view(text)); }
  template <std::same_as<bool> B>
  void Add(std::string_view name, B value) {
    Key(name) += value ? "true" : "false";
  }
  template <typename N>
  requires(std::integral<N> && !std::same_as<N, bool>) void Add(std::string_view name, N number) {
    using Wide = std::conditional_t<std::signed_integral<N>, std::int64_t, std::uint64_t>;
    AppendJsonNumber(static_cast<Wide>(number), Key(name));
  }
  template <std::floating_point N>
  void Add(std::string_view name, N number) {
    AppendJsonNumber(number, Key(name));
  }
  /// `json` is JSON.
  void AddJson(std::string_view name, std::string_view json) { Key(name) += json; }

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

}  // namespace runnel
