#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>

#include "core/base/nearest_name.h"
#include "plugins/json_values/internal/json_numbers.h"
#include "plugins/json_values/internal/leaf_types.h"
#include "plugins/json_values/internal/value_reader.h"

namespace runnel {

namespace {

std::vector<std::string> NamesOf(const TypeInfo& enumeration) {
  std::vector<std::string> names;
  for (const EnumeratorInfo& each : enumeration.enumerators()) names.push_back(each.name);
  return names;
}

}  // namespace

template <typename N>
Error ValueReader::DoesNotFit(std::string_view digits, const TypeInfo& type) {
  Error error = cursor_.ErrorHere("'" + std::string(digits) + "' does not fit into " + type.name());
  if constexpr (std::integral<N>) {
    error.hint = "allowed are whole numbers " + std::to_string(std::numeric_limits<N>::lowest()) +
                 " .. " + std::to_string(std::numeric_limits<N>::max());
  }
  return error;
}

template <typename N>
Result<void> ValueReader::ReadNumber(const TypeInfo& type, void* value) {
  if constexpr (std::floating_point<N>) {
    if (cursor_.SkipWord("null")) {
      *static_cast<N*>(value) = std::numeric_limits<N>::quiet_NaN();
      return {};
    }
  }
  const JsonCursor before = cursor_;
  const std::string_view digits = cursor_.TakeNumber();
  if (digits.empty()) {
    return cursor_.Expected(std::floating_point<N> ? "a number" : "a whole number");
  }
  const auto number = NumberOf<N>(digits);
  if (!number) {
    cursor_ = before;
    return DoesNotFit<N>(digits, type);
  }
  *static_cast<N*>(value) = *number;
  return {};
}

Result<void> ValueReader::ReadLeaf(const TypeInfo& type, void* value) {
  return WithLeafType(type, [&]<typename T>(std::type_identity<T>) -> Result<void> {
    if constexpr (std::same_as<T, bool>) {
      return ReadBool(value);
    } else if constexpr (std::is_arithmetic_v<T>) {
      return ReadNumber<T>(type, value);
    } else if constexpr (std::same_as<T, std::string>) {
      return cursor_.TakeString(*static_cast<std::string*>(value));
    } else if constexpr (std::same_as<T, Duration>) {
      return ReadDuration(type, *static_cast<Duration*>(value));
    } else if constexpr (std::same_as<T, Time>) {
      Duration since_start{};
      if (auto read = ReadDuration(type, since_start); !read) return read;
      *static_cast<Time*>(value) = Time(since_start);
      return {};
    } else {
      return ReadText(type, value);
    }
  });
}

Result<void> ValueReader::ReadBool(void* value) {
  const bool is_true = cursor_.SkipWord("true");
  if (!is_true && !cursor_.SkipWord("false")) return cursor_.Expected("true or false");
  *static_cast<bool*>(value) = is_true;
  return {};
}

Result<void> ValueReader::ReadText(const TypeInfo& type, void* value) {
  const JsonCursor before = cursor_;
  std::string text;
  if (auto taken = cursor_.TakeString(text); !taken) return taken;
  auto set = type.leaf().from_text(text, value);
  if (set) return set;
  cursor_ = before;
  Error error = cursor_.ErrorHere(set.error().message);
  error.hint = set.error().hint;
  return error;
}

Result<void> ValueReader::ReadDuration(const TypeInfo& type, Duration& duration) {
  static const std::string kSeconds = "sec", kNanoseconds = "nsec";
  constexpr std::int64_t kPerSecond = 1'000'000'000;
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  std::int64_t seconds = 0, nanoseconds = 0;
  auto read = ReadFields(type.name(), {&kSeconds, &kNanoseconds}, [&](std::size_t field) {
    return field == 0 ? ReadPart(seconds, -kMost, kMost) : ReadPart(nanoseconds, 0, kPerSecond - 1);
  });
  if (!read) return read;
  // The earliest time lies in a second whose begin cannot be said in nanoseconds.
  if (seconds < 0) {
    ++seconds;
    nanoseconds -= kPerSecond;
  }
  std::int64_t sum = 0;
  if (__builtin_mul_overflow(seconds, kPerSecond, &sum) ||
      __builtin_add_overflow(sum, nanoseconds, &sum)) {
    return cursor_.ErrorHere("a " + type.name() + " cannot be that long");
  }
  duration = Duration(sum);
  return {};
}

Result<void> ValueReader::ReadPart(std::int64_t& number, std::int64_t minimum,
                                   std::int64_t maximum) {
  const JsonCursor before = cursor_;
  const auto read = NumberOf<std::int64_t>(cursor_.TakeNumber());
  if (!read || *read < minimum || *read > maximum) {
    cursor_ = before;
    return cursor_.Expected("a whole number, " + std::to_string(minimum) + " .. " +
                            std::to_string(maximum));
  }
  number = *read;
  return {};
}

Result<void> ValueReader::ReadEnumeration(const TypeInfo& type, void* value) {
  if (cursor_.Peek() != '"') return ReadNumberOfEnumeration(type, value);
  const JsonCursor before = cursor_;
  std::string name;
  if (auto taken = cursor_.TakeString(name); !taken) return taken;
  const auto named = std::ranges::find(type.enumerators(), name, &EnumeratorInfo::name);
  if (named != type.enumerators().end()) {
    type.enumeration().set(value, named->value);
    return {};
  }
  cursor_ = before;
  Error error = cursor_.ErrorHere("there is no " + type.name() + " '" + name + "'");
  error.hint = NearestNameHint(name, NamesOf(type));
  return error;
}

Result<void> ValueReader::ReadNumberOfEnumeration(const TypeInfo& type, void* value) {
  const JsonCursor before = cursor_;
  const auto number = NumberOf<std::int64_t>(cursor_.TakeNumber());
  const auto named = std::ranges::find_if(
      type.enumerators(), [&](const EnumeratorInfo& each) { return number == each.value; });
  if (named != type.enumerators().end()) {
    type.enumeration().set(value, named->value);
    return {};
  }
  cursor_ = before;
  Error error = cursor_.Expected("the name of a " + type.name() + " in quotation marks");
  error.hint = NearestNameHint("", NamesOf(type));
  return error;
}

}  // namespace runnel
