#pragma once

#include <array>
#include <cstring>
#include <string>
#include <type_traits>

#include "plugins/genom_execution/value_views.h"

// Values of codels in C++ whose lists and texts are other classes than those of codels in C: to their views, which are the
// same for both, and back. What is a view already is only copied. Structs have overloads of their own, made from the
// description, beside their views.
namespace runnel::genom_execution {

template <typename View, typename Value>
void ToView(View& view, const Value& value);
template <typename E, std::size_t count, typename Value>
void ToView(std::array<E, count>& view, const Value& value);
template <typename E, std::size_t most, typename List>
void ToView(BoundedList<E, most>& view, const List& list);
template <typename E, typename List>
void ToView(OwnedList<E>& view, const List& list);
template <typename E, typename Optional>
void ToView(Presence<E>& view, const Optional& optional);

template <typename View, typename Value>
void ToCodel(Value& value, const View& view);
template <typename E, std::size_t count, typename Value>
void ToCodel(Value& value, const std::array<E, count>& view);
template <typename E, std::size_t most, typename List>
void ToCodel(List& list, const BoundedList<E, most>& view);
template <typename E, typename List>
void ToCodel(List& list, const OwnedList<E>& view);
template <typename E, typename Optional>
void ToCodel(Optional& optional, const Presence<E>& view);

inline void ToView(OwnedText& view, const std::string& text) { view.Set(text); }
inline void ToCodel(std::string& text, const OwnedText& view) { text = view.view(); }

namespace internal {

template <typename List, typename Elements>
void ListToCodel(List& list, const Elements& elements) {
  list.resize(elements.length);
  for (std::size_t i = 0; i < elements.length; ++i) {
    if constexpr (std::is_same_v<typename List::value_type, bool>) {  // those of std::vector<bool> are no lvalues
      list[i] = elements.buffer[i];
    } else {
      ToCodel(list[i], elements.buffer[i]);
    }
  }
}
template <typename List, typename Elements>
void ListToView(Elements& elements, const List& list) {
  if (!elements.Resize(list.size())) return;
  for (std::size_t i = 0; i < list.size(); ++i) ToView(elements.buffer[i], list[i]);
}

template <typename View, typename Value>
void CheckThatTheyAreAlike() {
  static_assert(sizeof(View) == sizeof(Value) && std::is_trivially_copyable_v<View> && std::is_trivially_copyable_v<Value>);
}

}  // namespace internal

template <typename View, typename Value>
void ToView(View& view, const Value& value) {
  internal::CheckThatTheyAreAlike<View, Value>();
  std::memcpy(static_cast<void*>(&view), &value, sizeof(view));
}
template <typename View, typename Value>
void ToCodel(Value& value, const View& view) {
  internal::CheckThatTheyAreAlike<View, Value>();
  std::memcpy(static_cast<void*>(&value), &view, sizeof(value));
}
template <typename E, std::size_t count, typename Value>
void ToView(std::array<E, count>& view, const Value& value) {
  for (std::size_t i = 0; i < count; ++i) ToView(view[i], value[i]);
}
template <typename E, std::size_t count, typename Value>
void ToCodel(Value& value, const std::array<E, count>& view) {
  for (std::size_t i = 0; i < count; ++i) ToCodel(value[i], view[i]);
}
template <typename E, std::size_t most, typename List>
void ToView(BoundedList<E, most>& view, const List& list) {
  internal::ListToView(view, list);
}
template <typename E, std::size_t most, typename List>
void ToCodel(List& list, const BoundedList<E, most>& view) {
  internal::ListToCodel(list, view);
}
template <typename E, typename List>
void ToView(OwnedList<E>& view, const List& list) {
  internal::ListToView(view, list);
}
template <typename E, typename List>
void ToCodel(List& list, const OwnedList<E>& view) {
  internal::ListToCodel(list, view);
}
template <typename E, typename Optional>
void ToView(Presence<E>& view, const Optional& optional) {
  view.is_present = optional._present;
  ToView(view.value, optional._value);
}
template <typename E, typename Optional>
void ToCodel(Optional& optional, const Presence<E>& view) {
  optional._present = view.is_present;
  ToCodel(optional._value, view.value);
}

}  // namespace runnel::genom_execution

namespace runnel::genom_modules {
using genom_execution::ToCodel;
using genom_execution::ToView;
}  // namespace runnel::genom_modules
