#pragma once

#include <array>
#include <cstring>
#include <type_traits>

#include "plugins/genom_execution/value_views.h"

// Values of codels in C++ whose lists and texts are other classes than those of codels in C: to their views, which are the
// same for both, and back. What is a view already is only copied. Structs have overloads of their own, made from the
// description, beside their views.
namespace runnel::genom_execution {

namespace internal {

template <typename View>
inline constexpr bool kIsPresence = false;
template <typename E>
inline constexpr bool kIsPresence<Presence<E>> = true;

template <typename View, typename Value>
void CheckThatTheyAreAlike() {
  static_assert(sizeof(View) == sizeof(Value) && std::is_trivially_copyable_v<View> &&
                std::is_trivially_copyable_v<Value>);
}

}  // namespace internal

template <typename View, typename Value>
void ToView(View& view, const Value& value) {
  if constexpr (std::is_same_v<View, OwnedText>) {
    view.Set(value);
  } else if constexpr (requires(View list) { list.Resize(1); }) {
    if (!view.Resize(value.size())) return;
    for (std::size_t i = 0; i < value.size(); ++i) ToView(view.buffer[i], value[i]);
  } else if constexpr (internal::kIsPresence<View>) {
    view.is_present = value._present;
    ToView(view.value, value._value);
  } else if constexpr (requires(View array) { array.size(); }) {
    for (std::size_t i = 0; i < view.size(); ++i) ToView(view[i], value[i]);
  } else {
    internal::CheckThatTheyAreAlike<View, Value>();
    std::memcpy(static_cast<void*>(&view), &value, sizeof(view));
  }
}

template <typename View, typename Value>
void ToCodel(Value& value, const View& view) {
  if constexpr (std::is_same_v<View, OwnedText>) {
    value = view.view();
  } else if constexpr (requires(View list) { list.Resize(1); }) {
    value.resize(view.length);
    for (std::size_t i = 0; i < value.size(); ++i) {
      if constexpr (std::is_same_v<typename Value::value_type, bool>) {  // those of std::vector<bool> are no lvalues
        value[i] = view.buffer[i];
      } else {
        ToCodel(value[i], view.buffer[i]);
      }
    }
  } else if constexpr (internal::kIsPresence<View>) {
    value._present = view.is_present;
    ToCodel(value._value, view.value);
  } else if constexpr (requires(View array) { array.size(); }) {
    for (std::size_t i = 0; i < view.size(); ++i) ToCodel(value[i], view[i]);
  } else {
    internal::CheckThatTheyAreAlike<View, Value>();
    std::memcpy(static_cast<void*>(&value), &view, sizeof(value));
  }
}

}  // namespace runnel::genom_execution

namespace runnel::genom_modules {
using genom_execution::ToCodel;
using genom_execution::ToView;
}  // namespace runnel::genom_modules
