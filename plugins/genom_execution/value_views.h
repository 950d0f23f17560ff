#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>

namespace runnel::genom_execution {

/// What codels in C know as types of their headers, C++ knows by types of the same layout that copy and give back what they
/// own: structs of those below. Nothing is converted. They may be moved by their bytes, and zeros are an empty value.
template <typename View, typename Value>
[[nodiscard]] View& As(Value& value) noexcept {
  static_assert(sizeof(View) == sizeof(Value) && alignof(View) <= alignof(Value), "another layout than the view's");
  return *reinterpret_cast<View*>(&value);
}

/// Empty again, in place.
template <typename View>
void Clear(View& view) noexcept {
  std::destroy_at(&view);
  std::uninitialized_value_construct_n(&view, 1);
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
  [[nodiscard]] std::string_view view() const noexcept {
    return text != nullptr ? std::string_view(text) : std::string_view();
  }
  void Set(std::string_view from) noexcept {
    char* const old = text;
    text = strndup(from.data(), from.size());
    std::free(old);
  }
  static char* Copy(const char* from) { return from != nullptr ? strdup(from) : nullptr; }
};

/// What `sequence<E, most>` holds: copied by its bytes if E is. Else elements beyond the length are empty, but are never
/// destroyed: codels in C may have moved their bytes.
template <typename E, std::size_t most, bool owns = !std::is_trivially_copyable_v<E>>
struct ListInPlace {
  std::uint32_t maximum = most;
  std::uint32_t length = 0;
  E buffer[most] = {};
};
template <typename E, std::size_t most>
struct ListInPlace<E, most, true> {
  std::uint32_t maximum = most;
  std::uint32_t length = 0;
  union {
    E buffer[most];
  };

  ListInPlace() noexcept { std::uninitialized_value_construct_n(buffer, most); }
  ListInPlace(const ListInPlace& other) : ListInPlace() { *this = other; }
  ListInPlace& operator=(const ListInPlace& other) {
    if (this == &other) return *this;
    const std::uint32_t before = std::exchange(length, 0);
    std::destroy_n(buffer, before);
    std::uninitialized_copy_n(other.buffer, other.length, buffer);
    length = other.length;
    if (before > length) std::uninitialized_value_construct_n(buffer + length, before - length);
    return *this;
  }
  ~ListInPlace() { std::destroy_n(buffer, length); }
};

/// `sequence<E, most>`: in place. Elements beyond the length own nothing, as in OwnedList.
template <typename E, std::size_t most>
struct BoundedList : ListInPlace<E, most> {
  /// False: that many do not fit. New ones are empty.
  bool Resize(std::size_t count) {
    if (count > most) return false;
    const std::size_t before = this->length;
    if (count < before) std::destroy_n(this->buffer + count, before - count);
    std::uninitialized_value_construct_n(this->buffer + std::min(count, before),
                                         std::max(count, before) - std::min(count, before));
    this->maximum = most;
    this->length = static_cast<std::uint32_t>(count);
    return true;
  }
};

/// `sequence<E>`: owned. Elements beyond the length own nothing, whatever their bytes are: codels in C move elements by
/// their bytes, and lower the length.
template <typename E>
struct OwnedList {
  std::uint32_t maximum = 0;
  std::uint32_t length = 0;
  E* buffer = nullptr;
  void (*release)(void*) = nullptr;

  OwnedList() = default;
  OwnedList(const OwnedList& other) { *this = other; }
  OwnedList& operator=(const OwnedList& other) {
    if (this != &other && Resize(other.length)) std::copy_n(other.buffer, length, buffer);
    return *this;
  }
  ~OwnedList() {
    if (release == nullptr) return;  // somebody else's
    std::destroy_n(buffer, length);
    release(buffer);
  }
  /// False: there is no memory. New elements are empty.
  bool Resize(std::size_t count) {
    if (count > maximum) {
      auto* const grown = static_cast<E*>(std::calloc(count, sizeof(E)));
      if (grown == nullptr) return false;
      if (length > 0) std::memcpy(static_cast<void*>(grown), buffer, length * sizeof(E));
      if (release != nullptr) release(buffer);
      buffer = grown;
      maximum = static_cast<std::uint32_t>(count);
      release = std::free;
    }
    if (count > length) std::uninitialized_value_construct_n(buffer + length, count - length);
    if (count < length && release != nullptr) std::destroy_n(buffer + count, length - count);
    length = static_cast<std::uint32_t>(count);
    return true;
  }
};

/// `optional<E>`.
template <typename E>
struct Presence {
  bool is_present = false;
  E value = {};
};

}  // namespace runnel::genom_execution
