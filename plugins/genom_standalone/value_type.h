#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <type_traits>

namespace runnel::genom_standalone {

enum class ValueKind : std::uint8_t {
  kBoolean, kOctet, kCharacter, kShort, kUnsignedShort, kLong, kUnsignedLong, kLongLong, kUnsignedLongLong, kFloat, kDouble,
  kEnum,           ///< a number of 32 bits; `names`
  kText,           ///< char[length]
  kOwnedText,      ///< char*, by malloc()
  kArray,          ///< of `length`
  kSequence,       ///< {_maximum, _length, _buffer[length]}
  kOwnedSequence,  ///< {_maximum, _length, *_buffer, *_release}
  kString,         ///< std::string
  kList,           ///< `list`; of `length` at most, 0: any
  kOptional,       ///< {_present, _value}
  kStruct,
  kUnion,          ///< {_d, _u}: `element` is the type of _d
  kNative          ///< the user's, never looked at
};

struct ValueType;

struct ValueMember {
  const char* name;
  std::size_t offset;
  const ValueType* type;
  std::span<const std::int64_t> labels = {};  ///< of a union: values of _d
  std::int64_t label = 0;                     ///< that _d gets when this member is set
};

/// What is done with a list whose layout is its own: a class of C++.
struct ListOperations {
  void (*make)(void* at);
  void (*destroy)(void* at);
  void (*copy)(void* to, const void* from);
  std::size_t (*length)(const void* at);
  bool (*resize)(void* at, std::size_t length);  ///< false: that many do not fit
  /// Calls use(of, ELEMENT) for each; it may change them.
  void (*for_each)(void* at, void (*use)(void* of, void* element), void* of);
};

template <typename List>
inline constexpr ListOperations kListOperations{
    .make = [](void* at) { ::new (at) List(); },
    .destroy = [](void* at) { static_cast<List*>(at)->~List(); },
    .copy = [](void* to, const void* from) { *static_cast<List*>(to) = *static_cast<const List*>(from); },
    .length = [](const void* at) -> std::size_t { return static_cast<const List*>(at)->size(); },
    .resize =
        [](void* at, std::size_t length) {
          auto& list = *static_cast<List*>(at);
          if (length > list.max_size()) return false;
          list.resize(length);
          return true;
        },
    .for_each =
        [](void* at, void (*use)(void* of, void* element), void* of) {
          auto& list = *static_cast<List*>(at);
          for (std::size_t i = 0; i < list.size(); ++i) {
            if constexpr (std::is_same_v<typename List::value_type, bool>) {  // of a vector: they have no place of their own
              bool element = list[i];
              use(of, &element);
              list[i] = element;
            } else {
              use(of, &list[i]);
            }
          }
        }};

/// How a value lies in memory, as codels see it. Made by a template; never changes.
struct ValueType {
  ValueKind kind;
  std::size_t size;
  std::size_t length = 0;
  const ValueType* element = nullptr;
  std::size_t element_offset = 0;  ///< of what a sequence, optional or union has behind its head
  std::span<const ValueMember> members = {};
  std::span<const char* const> names = {};
  const ListOperations* list = nullptr;
};

}  // namespace runnel::genom_standalone
