#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_fields.h"

namespace runnel::internal {

using Words = std::vector<std::string>;

// The words of enumerators, in their order.
inline const Words& WordsOf(OnFull) { return OnFullNames(); }
inline const Words& WordsOf(ThreadOptions::OnOverrun) { return OverrunNames(); }
inline const Words& WordsOf(ThreadOptions::Activation) { return ActivationNames(); }
inline const Words& WordsOf(Port::Direction) {
  static const Words words{"input", "output"};
  return words;
}
// The last one: as what is around it.
inline const Words& WordsOf(std::optional<LogLevel>) {
  static const Words words = [] {
    Words all(LogLevelNames().begin(), LogLevelNames().end());
    all.emplace_back("inherit");
    return all;
  }();
  return words;
}

template <typename T>
concept HasWords = requires(T value) {
  WordsOf(value);
};

template <typename T>
constexpr FieldForm::Kind KindOf() {
  if constexpr (std::is_same_v<T, bool>) return FieldForm::Kind::kFlag;
  if constexpr (std::is_same_v<T, Duration>) return FieldForm::Kind::kDuration;
  if constexpr (std::is_same_v<T, Words>) return FieldForm::Kind::kTexts;
  if constexpr (std::is_same_v<T, std::vector<Setting>>) return FieldForm::Kind::kSettings;
  return std::is_integral_v<T> ? FieldForm::Kind::kCount : FieldForm::Kind::kText;
}

// What a member says, and back: enumerators are words, whole numbers counts.
inline FieldValue ValueOf(const std::optional<LogLevel>& level) { return level ? LogLevelName(*level) : "inherit"; }
inline void Put(std::optional<LogLevel>& level, FieldValue value) {
  const auto found = LogLevelOf(std::get<std::string>(value));
  level = found ? std::optional(*found) : std::nullopt;
}
template <typename T>
FieldValue ValueOf(const T& member) {
  if constexpr (HasWords<T>) {
    return WordsOf(member)[static_cast<std::size_t>(member)];
  } else if constexpr (KindOf<T>() == FieldForm::Kind::kCount) {
    return static_cast<std::uint64_t>(member);
  } else {
    return member;
  }
}
template <typename T>
void Put(T& member, FieldValue value) {
  if constexpr (HasWords<T>) {
    member = static_cast<T>(std::ranges::find(WordsOf(member), std::get<std::string>(value)) - WordsOf(member).begin());
  } else if constexpr (KindOf<T>() == FieldForm::Kind::kCount) {
    member = static_cast<T>(std::get<std::uint64_t>(value));
  } else {
    member = std::get<T>(std::move(value));
  }
}
template <typename T>
FieldValue ValueOf(const std::optional<T>& member) {
  return member ? ValueOf(*member) : FieldValue();
}
template <typename T>
void Put(std::optional<T>& member, FieldValue value) {
  Put(member.emplace(), std::move(value));
}

template <typename Owner, typename T>
Owner OwnerOf(T Owner::*);
template <typename T>
std::optional<T> AsOptional(const T&);
template <typename T>
std::optional<T> AsOptional(const std::optional<T>&);

template <typename T>
T& MemberAt(T& member) {
  return member;
}
template <typename T, typename First, typename... Rest>
auto& MemberAt(T& object, First first, Rest... rest) {
  return MemberAt(object.*first, rest...);
}

// A field that is a member of a change, or of a member of it.
template <auto First, auto... Rest>
FieldForm Member(FieldForm field) {
  using Said = decltype(OwnerOf(First));
  using T = typename decltype(AsOptional(MemberAt(std::declval<Said&>(), First, Rest...)))::value_type;
  field.kind = HasWords<T> ? FieldForm::Kind::kText : KindOf<T>();
  if constexpr (HasWords<T>) field.words = WordsOf(T{});
  if (field.kind == FieldForm::Kind::kFlag) field.words = {"false", "true"};
  field.get = [](const Change& change) { return ValueOf(MemberAt(std::get<Said>(change), First, Rest...)); };
  field.set = [](Change& change, FieldValue value) {
    Put(MemberAt(std::get<Said>(change), First, Rest...), std::move(value));
  };
  return field;
}

}  // namespace runnel::internal
