#include <concepts>
#include <cstdint>
#include <limits>
#include <string>

#include "core/types/leaf_types.h"
#include "core/types/type_builder.h"
#include "core/types/value_tokens.h"
#include "plugins/values/internal/json_number.h"
#include "plugins/values/json_reader.h"
#include "plugins/values/json_values.h"

namespace runnel {

namespace {

template <typename N>
Result<void> ReadNumber(const TypeInfo& type, const ValueToken& token, N& value) {
  using Limits = std::numeric_limits<N>;
  constexpr bool kIsWhole = std::integral<N>;
  if (!kIsWhole && token.kind == ValueToken::Kind::kWord && token.text == "null") {
    value = Limits::quiet_NaN();
    return {};
  }
  if (!internal::IsNumber(token)) return Expected(kIsWhole ? "a whole number" : "a number", token);
  const auto number = internal::NumberOf<N>(token);
  if (!number) {
    return Error{.message = "'" + token.text + "' does not fit into " + type.name(),
                 .hint = kIsWhole ? "allowed are whole numbers " + std::to_string(Limits::lowest()) + " .. " +
                                        std::to_string(Limits::max())
                                  : ""};
  }
  value = *number;
  return {};
}

// {"sec":-1,"nsec":500000000}
struct SecondsAndRest {
  std::int64_t sec = 0;
  std::int64_t nsec = 0;
};

Result<void> SetLeafFromJson(const TypeInfo& type, const ValueToken& token, void* value);

Result<void> ReadDuration(const TypeInfo& type, const ValueToken& token, Duration& value) {
  constexpr std::int64_t kPerSecond = 1'000'000'000;
  TypeInfo description(typeid(SecondsAndRest));  // of this only, and known to nobody
  TypeBuilder<SecondsAndRest>(description).Name(type.name()).Fields<&SecondsAndRest::sec, &SecondsAndRest::nsec>();
  SecondsAndRest parts;
  if (auto read = SetFromTokens(description, token, SetLeafFromJson, &parts); !read) return read;
  if (parts.nsec < 0 || parts.nsec >= kPerSecond) {
    return Error{.message = "'nsec' is a number from 0 to 999999999, not " + std::to_string(parts.nsec)};
  }
  // The earliest time lies in a second whose begin cannot be said in nanoseconds.
  if (parts.sec < 0) {
    ++parts.sec;
    parts.nsec -= kPerSecond;
  }
  std::int64_t sum = 0;
  if (__builtin_mul_overflow(parts.sec, kPerSecond, &sum) || __builtin_add_overflow(sum, parts.nsec, &sum)) {
    return Error{.message = "a " + type.name() + " cannot be that long"};
  }
  value = Duration(sum);
  return {};
}

Result<void> SetLeafFromJson(const TypeInfo& type, const ValueToken& token, void* value) {
  return WithLeafType(type, [&]<typename T>(std::type_identity<T>) -> Result<void> {
    if constexpr (std::same_as<T, bool>) {
      const bool is_word = token.kind == ValueToken::Kind::kWord;
      if (!is_word || (token.text != "true" && token.text != "false")) {
        return Expected("true or false", token);
      }
      *static_cast<bool*>(value) = token.text == "true";
      return {};
    } else if constexpr (std::is_arithmetic_v<T>) {
      return ReadNumber(type, token, *static_cast<T*>(value));
    } else if constexpr (std::same_as<T, Duration> || std::same_as<T, Time>) {
      Duration duration{};
      if (auto read = ReadDuration(type, token, duration); !read) return read;
      *static_cast<T*>(value) = T(duration);
      return {};
    } else {
      // A text, or what has a text format of its own.
      if (token.kind == ValueToken::Kind::kText) return type.leaf().from_text(token.text, value);
      return Expected("a text in quotation marks", token);
    }
  });
}

}  // namespace

Result<void> SetFromJson(const TypeInfo& type, const JsonPart& json, void* value) {
  return SetFromTokens(type, json.token(), SetLeafFromJson, value);
}

Result<void> SetFromJson(const TypeInfo& type, std::string_view json, void* value) {
  const auto part = JsonPart::Parse(json);
  return part ? SetFromJson(type, *part, value) : part.error();
}

}  // namespace runnel
