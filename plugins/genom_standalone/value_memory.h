#pragma once

#include <functional>

#include "plugins/genom_standalone/value_type.h"

namespace runnel::genom_standalone {

/// A sequence without a bound, whatever it is of.
struct OwnedSequence {
  std::uint32_t maximum;
  std::uint32_t length;
  std::byte* buffer;
  void (*release)(void*);
};

/// A sequence with one: its head.
struct SequenceHead {
  std::uint32_t maximum;
  std::uint32_t length;
};

/// Makes of zeros an empty value: sequences with a bound say how many they hold, what has a constructor is constructed.
void Initialise(const ValueType& type, void* value);
/// Gives back what it owns. It is to be initialised again, or gone.
void Release(const ValueType& type, void* value);
/// Preconditions: both are initialised.
void Copy(const ValueType& type, void* to, const void* from);
/// Makes room for so many; false: there is none. `value` is a sequence, not an array.
[[nodiscard]] bool Resize(const ValueType& type, void* value, std::uint32_t length);
/// Calls use(ELEMENT) for each of an array or sequence; false ends it.
void ForEachElement(const ValueType& type, void* value, const std::function<bool(void*)>& use);
[[nodiscard]] std::size_t LengthOf(const ValueType& type, const void* value);
/// Of a union: which member is set, nullptr if none.
[[nodiscard]] const ValueMember* ChosenMember(const ValueType& type, const void* value);
/// A whole number, boolean, character or enumerator.
[[nodiscard]] std::int64_t WholeNumber(const ValueType& type, const void* value);
void SetWholeNumber(const ValueType& type, void* value, std::int64_t number);

}  // namespace runnel::genom_standalone
