#pragma once

#include <string>
#include <string_view>

#include "core/types/type_of.h"
#include "plugins/genom_execution/value_views.h"

// What the views of codels' values are to Runnel.
namespace runnel::genom_execution {

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

inline void Describe(TypeBuilder<OwnedText>& type) {
  type.Name("genom string")
      .Leaf({.to_text = [](const void* at) { return std::string(static_cast<const OwnedText*>(at)->view()); },
             .from_text = [](std::string_view text, void* at) -> Result<void> {
               static_cast<OwnedText*>(at)->Set(text);
               return {};
             },
             .needs_quotes = true});
}

namespace internal {

template <typename List, typename E>
void DescribeList(TypeBuilder<List>& type) {
  type.Elements(
      TypeKind::kSequence,
      {.type = &TypeOf<E>(),
       .columns = [](const void* at) -> std::size_t { return static_cast<const List*>(at)->length; },
       .resize = [](void* at, std::size_t, std::size_t columns) { return static_cast<List*>(at)->Resize(columns); },
       .element = [](void* at, std::size_t index) -> void* { return &static_cast<List*>(at)->buffer[index]; }});
}

}  // namespace internal

template <typename E, std::size_t most>
void Describe(TypeBuilder<BoundedList<E, most>>& type) {
  type.Name(TypeOf<E>().name() + "[<=" + std::to_string(most) + "]");
  internal::DescribeList<BoundedList<E, most>, E>(type);
}

template <typename E>
void Describe(TypeBuilder<OwnedList<E>>& type) {
  type.Name("genom " + TypeOf<E>().name() + "[]");
  internal::DescribeList<OwnedList<E>, E>(type);
}

/// As a list of one element or none.
template <typename E>
void Describe(TypeBuilder<Presence<E>>& type) {
  type.Name("genom " + TypeOf<E>().name() + "?")
      .Elements(
          TypeKind::kSequence,
          {.type = &TypeOf<E>(),
           .columns = [](const void* at) -> std::size_t { return static_cast<const Presence<E>*>(at)->is_present; },
           .resize =
               [](void* at, std::size_t, std::size_t columns) {
                 if (columns > 1) return false;
                 static_cast<Presence<E>*>(at)->is_present = columns == 1;
                 return true;
               },
           .element = [](void* at, std::size_t) -> void* { return &static_cast<Presence<E>*>(at)->value; }});
}

}  // namespace runnel::genom_execution

namespace runnel::genom_modules {

/// The default of a description, in the text format; what cannot be is left out.
template <typename T>
[[nodiscard]] T ValueOf(std::string_view text) {
  T value{};
  (void)SetFromText(TypeOf<T>(), text, &value);
  return value;
}

}  // namespace runnel::genom_modules
