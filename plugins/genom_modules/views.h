#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "core/types/type_of.h"

namespace runnel::genom_modules {

/// What codels in C know as types of their headers, Runnel knows by types with a description, of the same layout: structs
/// as they are, the rest by those below. Nothing is converted.
template <typename View, typename Value>
[[nodiscard]] View& As(Value& value) noexcept {
  static_assert(sizeof(View) == sizeof(Value) && alignof(View) <= alignof(Value), "another layout than the view's");
  return *reinterpret_cast<View*>(&value);
}

/// `string<length>`: char[length], which need not end with a zero.
template <std::size_t length>
struct BoundedText {
  char text[length] = {};

  [[nodiscard]] std::string_view view() const noexcept { return {text, strnlen(text, length)}; }
  /// What does not fit is cut off.
  void Set(std::string_view from) noexcept {
    std::memset(text, 0, length);
    std::memcpy(text, from.data(), std::min(from.size(), length));
  }
};

template <std::size_t length>
void Describe(TypeBuilder<BoundedText<length>>& type) {
  using Text = BoundedText<length>;
  type.Name("string<" + std::to_string(length) + ">")
      .Leaf({.to_text = [](const void* at) { return std::string(static_cast<const Text*>(at)->view()); },
             .from_text = [](std::string_view text, void* at) -> Result<void> {
               if (text.size() > length) {
                 return Error{.message = "the text has " + std::to_string(text.size()) + " characters; " +
                                         std::to_string(length) + " are allowed"};
               }
               static_cast<Text*>(at)->Set(text);
               return {};
             },
             .needs_quotes = true});
}

/// `string`: owned, by malloc(); nullptr is empty.
struct OwnedText {
  char* text = nullptr;

  OwnedText() = default;
  OwnedText(const OwnedText& other) : text(Copy(other.text)) {}
  OwnedText& operator=(const OwnedText& other) {
    if (this == &other) return *this;
    std::free(text);
    text = Copy(other.text);
    return *this;
  }
  ~OwnedText() { std::free(text); }
  static char* Copy(const char* from) { return from != nullptr ? strdup(from) : nullptr; }
};

inline void Describe(TypeBuilder<OwnedText>& type) {
  type.Name("genom string")
      .Leaf({.to_text =
                 [](const void* at) {
                   const char* const text = static_cast<const OwnedText*>(at)->text;
                   return std::string(text != nullptr ? text : "");
                 },
             .from_text = [](std::string_view text, void* at) -> Result<void> {
               auto& owned = static_cast<OwnedText*>(at)->text;
               std::free(owned);
               owned = strndup(text.data(), text.size());
               return {};
             },
             .needs_quotes = true});
}

/// `sequence<E, most>`: in place.
template <typename E, std::size_t most>
struct BoundedList {
  std::uint32_t maximum = most;
  std::uint32_t length = 0;
  E buffer[most] = {};
};

template <typename E, std::size_t most>
void Describe(TypeBuilder<BoundedList<E, most>>& type) {
  using List = BoundedList<E, most>;
  type.Name(TypeOf<E>().name() + "[<=" + std::to_string(most) + "]")
      .Elements(TypeKind::kSequence,
                {.type = &TypeOf<E>(),
                 .is_fixed = false,
                 .rows = [](const void*) -> std::size_t { return 1; },
                 .columns = [](const void* at) -> std::size_t { return static_cast<const List*>(at)->length; },
                 .resize =
                     [](void* at, std::size_t, std::size_t columns) {
                       if (columns > most) return false;
                       auto& list = *static_cast<List*>(at);
                       for (std::size_t i = list.length; i < columns; ++i) list.buffer[i] = {};
                       list.maximum = most;
                       list.length = static_cast<std::uint32_t>(columns);
                       return true;
                     },
                 .element = [](void* at, std::size_t index) -> void* {
                   return &static_cast<List*>(at)->buffer[index];
                 }});
}

/// `sequence<E>`: owned. E owns nothing itself.
template <typename E>
struct OwnedList {
  std::uint32_t maximum = 0;
  std::uint32_t length = 0;
  E* buffer = nullptr;
  void (*release)(void*) = nullptr;

  OwnedList() = default;
  OwnedList(const OwnedList& other) { *this = other; }
  OwnedList& operator=(const OwnedList& other) {
    static_assert(std::is_trivially_copyable_v<E>);
    if (this == &other || !Resize(other.length)) return *this;
    if (length > 0) std::memcpy(buffer, other.buffer, length * sizeof(E));
    return *this;
  }
  ~OwnedList() {
    if (release != nullptr) release(buffer);
  }
  bool Resize(std::size_t count) {
    if (count > maximum) {
      auto* const grown = static_cast<E*>(std::calloc(count, sizeof(E)));
      if (grown == nullptr) return false;
      if (length > 0) std::memcpy(grown, buffer, length * sizeof(E));
      if (release != nullptr) release(buffer);
      buffer = grown;
      maximum = static_cast<std::uint32_t>(count);
      release = std::free;
    } else if (count > length) {
      std::memset(buffer + length, 0, (count - length) * sizeof(E));
    }
    length = static_cast<std::uint32_t>(count);
    return true;
  }
};

template <typename E>
void Describe(TypeBuilder<OwnedList<E>>& type) {
  using List = OwnedList<E>;
  type.Name("genom " + TypeOf<E>().name() + "[]")
      .Elements(TypeKind::kSequence,
                {.type = &TypeOf<E>(),
                 .is_fixed = false,
                 .rows = [](const void*) -> std::size_t { return 1; },
                 .columns = [](const void* at) -> std::size_t { return static_cast<const List*>(at)->length; },
                 .resize = [](void* at, std::size_t, std::size_t columns) {
                   return static_cast<List*>(at)->Resize(columns);
                 },
                 .element = [](void* at, std::size_t index) -> void* {
                   return &static_cast<List*>(at)->buffer[index];
                 }});
}

/// `optional<E>`, as a list of one element or none.
template <typename E>
struct Presence {
  bool is_present = false;
  E value = {};
};

template <typename E>
void Describe(TypeBuilder<Presence<E>>& type) {
  type.Name("genom " + TypeOf<E>().name() + "?")
      .Elements(TypeKind::kSequence,
                {.type = &TypeOf<E>(),
                 .is_fixed = false,
                 .rows = [](const void*) -> std::size_t { return 1; },
                 .columns = [](const void* at) -> std::size_t { return static_cast<const Presence<E>*>(at)->is_present; },
                 .resize =
                     [](void* at, std::size_t, std::size_t columns) {
                       if (columns > 1) return false;
                       static_cast<Presence<E>*>(at)->is_present = columns == 1;
                       return true;
                     },
                 .element = [](void* at, std::size_t) -> void* { return &static_cast<Presence<E>*>(at)->value; }});
}

/// The default of a description, in the text format; what cannot be is left out.
template <typename T>
[[nodiscard]] T ValueOf(std::string_view text) {
  T value{};
  (void)SetFromText(TypeOf<T>(), text, &value);
  return value;
}

}  // namespace runnel::genom_modules
