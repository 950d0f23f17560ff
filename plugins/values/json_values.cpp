#include "plugins/values/json_values.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "core/base/characters.h"
#include "core/base/clock.h"
#include "core/types/leaf_types.h"
#include "core/types/type_builder.h"
#include "core/types/type_info.h"
#include "core/types/value_tokens.h"
#include "plugins/values/internal/json_number.h"
#include "plugins/values/json_reader.h"
#include "plugins/values/json_writer.h"

namespace runnel {

namespace {

template <typename T>
const T& As(const void* value) {
  return *static_cast<const T*>(value);
}

class ValueWriter {
 public:
  ValueWriter(std::string& json, const JsonLimits& limits)
      : json_(json),
        limits_(limits),
        end_(limits.bytes > JsonLimits::kNone - json.size() ? JsonLimits::kNone : json.size() + limits.bytes) {}

  [[nodiscard]] bool is_whole() const noexcept { return is_whole_; }

  void Write(const TypeInfo& type, const void* value) {
    switch (type.kind()) {
      case TypeKind::kOpaque:
        json_ += "null";
        return;
      case TypeKind::kLeaf:
        return WriteLeaf(type, value);
      case TypeKind::kEnumeration:
        return WriteEnumeration(type, value);
      case TypeKind::kStructure:
        return WriteStructure(type, value);
      case TypeKind::kSequence:
        return WriteRow(type, value, 0);
      case TypeKind::kMatrix:
        return WriteList(type.elements().rows(value), [&](std::size_t row) { WriteRow(type, value, row); });
    }
  }

 private:
  [[nodiscard]] bool IsFull() const noexcept { return json_.size() >= end_; }

  void WriteLeaf(const TypeInfo& type, const void* value) {
    WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
      if constexpr (std::same_as<T, bool>) {
        json_ += As<bool>(value) ? "true" : "false";
      } else if constexpr (std::integral<T>) {
        AppendJsonNumber(As<T>(value), json_);
      } else if constexpr (std::floating_point<T>) {
        WriteFloating(As<T>(value));
      } else if constexpr (std::same_as<T, std::string>) {
        WriteText(As<std::string>(value));
      } else if constexpr (std::same_as<T, Duration>) {
        WriteSeconds(As<Duration>(value));
      } else if constexpr (std::same_as<T, Time>) {
        WriteSeconds(As<Time>(value).time_since_epoch());
      } else {
        WriteText(type.leaf().to_text(value));
      }
    });
  }

  template <typename N>
  void WriteFloating(N number) {
    if (std::isinf(number) && !limits_.has_infinity) {
      json_ += "null";
    } else {
      AppendJsonNumber(number, json_);
    }
  }

  void WriteText(std::string_view text) {
    const std::size_t most = IsFull() ? 0 : std::min(limits_.characters, end_ - json_.size());
    if (text.size() <= most) return AppendJsonString(text, json_);
    is_whole_ = false;
    AppendJsonString(Shortened(std::string(text.substr(0, most + 1)), most), json_);
  }

  void WriteSeconds(Duration duration) {
    const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
    JsonObject(json_).Add("sec", seconds.count()).Add("nsec", (duration - seconds).count());
  }

  void WriteEnumeration(const TypeInfo& type, const void* value) {
    const std::int64_t number = type.enumeration().get(value);
    const auto named = std::ranges::find(type.enumerators(), number, &EnumeratorInfo::value);
    if (named == type.enumerators().end()) return AppendJsonNumber(number, json_);
    AppendJsonString(named->name, json_);
  }

  void WriteStructure(const TypeInfo& type, const void* value) {
    JsonObject object(json_);
    for (const FieldInfo& field : type.fields()) {
      object.Key(field.name);
      Write(*field.type, field.address(ForLooking(value)));
    }
  }

  void WriteRow(const TypeInfo& type, const void* value, std::size_t row) {
    const ElementOperations& elements = type.elements();
    const std::size_t columns = elements.columns(value);
    WriteList(columns,
              [&](std::size_t i) { Write(*elements.type, elements.element(ForLooking(value), row * columns + i)); });
  }

  template <typename WriteOne>
  void WriteList(std::size_t count, const WriteOne& write_one) {
    const std::size_t shown = std::min(count, limits_.elements);
    std::size_t i = 0;
    JsonArray list(json_);
    for (; i < shown && !IsFull(); ++i) {
      list.Next();
      write_one(i);
    }
    if (i < count) is_whole_ = false;
  }

  std::string& json_;
  const JsonLimits& limits_;
  const std::size_t end_;
  bool is_whole_ = true;
};

}  // namespace

bool AppendJson(const TypeInfo& type, const void* value, std::string& json, const JsonLimits& limits) {
  ValueWriter writer(json, limits);
  writer.Write(type, value);
  return writer.is_whole();
}

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
