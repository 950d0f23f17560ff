#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <new>
#include <span>
#include <type_traits>

#include "plugins/genom_execution/value_views.h"

namespace runnel::genom_standalone {

enum class ValueKind : std::uint8_t {
  kBoolean,
  kOctet,
  kCharacter,
  kShort,
  kUnsignedShort,
  kLong,
  kUnsignedLong,
  kLongLong,
  kUnsignedLongLong,
  kFloat,
  kDouble,
  kEnum,       ///< a number of 32 bits; `names`
  kText,       ///< char[length]
  kOwnedText,  ///< an OwnedText
  kString,     ///< std::string
  kList,       ///< an array or a sequence: `list`; of `length` at most, 0: any
  kOptional,   ///< {_present, _value}
  kStruct,
  kUnion,  ///< {_d, _u}: `element` is the type of _d
  kNative  ///< the user's, never looked at
};

struct ValueType;

struct ValueMember {
  const char* name;
  std::size_t offset;
  const ValueType* type;
  std::span<const std::int64_t> labels = {};  ///< of a union: values of _d
  std::int64_t label = 0;                     ///< that _d gets when this member is set
};

/// What C++ does with values of a type.
struct ValueMemory {
  std::size_t size = 0;
  void (*make)(void* at) = nullptr;  ///< as in the beginning
  void (*destroy)(void* at) = nullptr;
  void (*copy)(void* to, const void* from) = nullptr;
};

namespace internal {

/// Arrays, too, are made and copied where they are members.
template <typename T>
struct Held {
  T value;
};

}  // namespace internal

template <typename T>
inline constexpr ValueMemory kMemory{.size = sizeof(T),
                                     .make = [](void* at) { ::new (at) internal::Held<T>(); },
                                     .destroy = [](void* at) { static_cast<internal::Held<T>*>(at)->~Held(); },
                                     .copy =
                                         [](void* to, const void* from) {
                                           *static_cast<internal::Held<T>*>(to) =
                                               *static_cast<const internal::Held<T>*>(from);
                                         }};

/// What is done with lists: arrays, classes of C++, views of those in C.
struct ListOperations {
  bool (*resize)(void* at, std::size_t length);  ///< false: that many do not fit; an array stays as it is
  /// Calls use(ELEMENT) for each, which may change it; false ends it.
  void (*for_each)(void* at, const std::function<bool(void*)>& use);
};

template <typename List>
inline constexpr ListOperations kListOperations{
    .resize = [](void* at, std::size_t length) -> bool {
      auto& list = *static_cast<List*>(at);
      if constexpr (requires { list.Resize(length); }) {
        return list.Resize(length);
      } else if constexpr (requires { list.resize(length); }) {
        if (length > list.max_size()) return false;
        list.resize(length);
        return true;
      } else {
        return length <= std::size(list);
      }
    },
    .for_each =
        [](void* at, const std::function<bool(void*)>& use) {
          auto& list = *static_cast<List*>(at);
          if constexpr (requires { list.buffer; }) {
            for (std::size_t i = 0; i < list.length && use(&list.buffer[i]); ++i) {
            }
          } else {
            for (auto&& each : list) {
              if constexpr (std::is_lvalue_reference_v<decltype(each)>) {
                if (!use(&each)) return;
              } else {  // of a vector of bool: they have no place of their own
                bool element = each;
                const bool goes_on = use(&element);
                each = element;
                if (!goes_on) return;
              }
            }
          }
        }};

/// How a value lies in memory, as codels see it. Made by a template; never changes.
struct ValueType {
  ValueKind kind;
  ValueMemory memory = {};
  std::size_t length = 0;
  const ValueType* element = nullptr;
  std::size_t element_offset = 0;  ///< of what an optional has behind its head
  std::span<const ValueMember> members = {};
  std::span<const char* const> names = {};
  const ListOperations* list = nullptr;
  bool is_array = false;  ///< a list that has always `length` elements
};

}  // namespace runnel::genom_standalone
