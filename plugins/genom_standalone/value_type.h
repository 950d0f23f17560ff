#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace runnel::genom_standalone {

enum class ValueKind : std::uint8_t {
  kBoolean, kOctet, kCharacter, kShort, kUnsignedShort, kLong, kUnsignedLong, kLongLong, kUnsignedLongLong, kFloat, kDouble,
  kEnum,           ///< a number of 32 bits; `names`
  kText,           ///< char[length]
  kOwnedText,      ///< char*, by malloc()
  kArray,          ///< of `length`
  kSequence,       ///< {_maximum, _length, _buffer[length]}
  kOwnedSequence,  ///< {_maximum, _length, *_buffer, *_release}
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

/// How a value lies in memory, as codels in C see it. Made by a template; never changes.
struct ValueType {
  ValueKind kind;
  std::size_t size;
  std::size_t length = 0;
  const ValueType* element = nullptr;
  std::size_t element_offset = 0;  ///< of what a sequence, optional or union has behind its head
  std::span<const ValueMember> members = {};
  std::span<const char* const> names = {};
};

}  // namespace runnel::genom_standalone
