#include "plugins/genom_standalone/value_memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

namespace runnel::genom_standalone {

namespace {

template <typename Number>
Number Load(const void* from) {
  Number number;
  std::memcpy(&number, from, sizeof(number));
  return number;
}

template <typename Number>
void Store(void* to, std::int64_t number) {
  const auto narrow = static_cast<Number>(number);
  std::memcpy(to, &narrow, sizeof(narrow));
}

std::byte* At(void* value, std::size_t offset) { return static_cast<std::byte*>(value) + offset; }
const std::byte* At(const void* value, std::size_t offset) { return static_cast<const std::byte*>(value) + offset; }

std::byte* Elements(const ValueType& type, void* value) {
  if (type.kind == ValueKind::kOwnedSequence) return static_cast<OwnedSequence*>(value)->buffer;
  return At(value, type.element_offset);
}

/// Everything within that is of another type, with where it lies. Of a union only what is set.
template <typename Use>
void ForEachPart(const ValueType& type, void* value, Use use) {
  switch (type.kind) {
    case ValueKind::kStruct:
      for (const ValueMember& each : type.members) use(*each.type, At(value, each.offset));
      break;
    case ValueKind::kUnion:
      if (const ValueMember* chosen = ChosenMember(type, value)) use(*chosen->type, At(value, chosen->offset));
      break;
    case ValueKind::kOptional:
      use(*type.element, At(value, type.element_offset));
      break;
    case ValueKind::kArray: case ValueKind::kSequence: case ValueKind::kOwnedSequence: {
      // All that has room, for elements beyond the length keep what they own.
      const std::size_t count =
          type.kind == ValueKind::kOwnedSequence ? static_cast<OwnedSequence*>(value)->maximum : type.length;
      for (std::size_t i = 0; i < count; ++i) use(*type.element, Elements(type, value) + i * type.element->size);
      break;
    }
    default: break;
  }
}

}  // namespace

std::int64_t WholeNumber(const ValueType& type, const void* value) {
  switch (type.kind) {
    case ValueKind::kBoolean: return Load<bool>(value) ? 1 : 0;
    case ValueKind::kOctet: return Load<std::uint8_t>(value);
    case ValueKind::kCharacter: return Load<char>(value);
    case ValueKind::kShort: return Load<std::int16_t>(value);
    case ValueKind::kUnsignedShort: return Load<std::uint16_t>(value);
    case ValueKind::kLong: return Load<std::int32_t>(value);
    case ValueKind::kUnsignedLong: case ValueKind::kEnum: return Load<std::uint32_t>(value);
    case ValueKind::kLongLong: case ValueKind::kUnsignedLongLong: return Load<std::int64_t>(value);
    default: return 0;
  }
}

void SetWholeNumber(const ValueType& type, void* value, std::int64_t number) {
  switch (type.kind) {
    case ValueKind::kBoolean: Store<bool>(value, number); break;
    case ValueKind::kOctet: Store<std::uint8_t>(value, number); break;
    case ValueKind::kCharacter: Store<char>(value, number); break;
    case ValueKind::kShort: Store<std::int16_t>(value, number); break;
    case ValueKind::kUnsignedShort: Store<std::uint16_t>(value, number); break;
    case ValueKind::kLong: Store<std::int32_t>(value, number); break;
    case ValueKind::kUnsignedLong: case ValueKind::kEnum: Store<std::uint32_t>(value, number); break;
    case ValueKind::kLongLong: case ValueKind::kUnsignedLongLong: Store<std::int64_t>(value, number); break;
    default: break;
  }
}

const ValueMember* ChosenMember(const ValueType& type, const void* value) {
  const std::int64_t chosen = WholeNumber(*type.element, value);
  const ValueMember* otherwise = nullptr;
  for (const ValueMember& each : type.members) {
    if (std::ranges::find(each.labels, chosen) != each.labels.end()) return &each;
    if (each.labels.empty()) otherwise = &each;
  }
  return otherwise;
}

void ForEachElement(const ValueType& type, void* value, const std::function<bool(void*)>& use) {
  if (type.list == nullptr) {
    for (std::size_t i = 0; i < LengthOf(type, value); ++i) {
      if (!use(Elements(type, value) + i * type.element->size)) return;
    }
    return;
  }
  struct Using {
    const std::function<bool(void*)>& use;
    bool goes_on = true;
  } each{use};
  type.list->for_each(value, [](void* of, void* element) {
    auto& all = *static_cast<Using*>(of);
    all.goes_on = all.goes_on && all.use(element);
  }, &each);
}

std::size_t LengthOf(const ValueType& type, const void* value) {
  if (type.list != nullptr) return type.list->length(value);
  switch (type.kind) {
    case ValueKind::kOwnedSequence: return static_cast<const OwnedSequence*>(value)->length;
    case ValueKind::kSequence: return static_cast<const SequenceHead*>(value)->length;
    default: return type.length;
  }
}

void Initialise(const ValueType& type, void* value) {
  if (type.kind == ValueKind::kSequence) static_cast<SequenceHead*>(value)->maximum = static_cast<std::uint32_t>(type.length);
  if (type.kind == ValueKind::kString) ::new (value) std::string();
  if (type.list != nullptr) type.list->make(value);
  ForEachPart(type, value, [](const ValueType& part, void* at) { Initialise(part, at); });
}

void Release(const ValueType& type, void* value) {
  ForEachPart(type, value, [](const ValueType& part, void* at) { Release(part, at); });
  if (type.kind == ValueKind::kOwnedText) std::free(Load<char*>(value));
  if (type.kind == ValueKind::kString) static_cast<std::string*>(value)->~basic_string();
  if (type.list != nullptr) type.list->destroy(value);
  if (type.kind == ValueKind::kOwnedSequence) {
    auto& sequence = *static_cast<OwnedSequence*>(value);
    if (sequence.release != nullptr && sequence.buffer != nullptr) sequence.release(sequence.buffer);
  }
  std::memset(value, 0, type.size);
}

bool Resize(const ValueType& type, void* value, std::uint32_t length) {
  if (type.list != nullptr) return type.list->resize(value, length);
  if (type.kind != ValueKind::kOwnedSequence) {
    if (length > type.length) return false;
    static_cast<SequenceHead*>(value)->length = length;
    return true;
  }
  auto& sequence = *static_cast<OwnedSequence*>(value);
  if (length > sequence.maximum) {
    auto* const grown = static_cast<std::byte*>(std::calloc(length, type.element->size));
    if (grown == nullptr) return false;
    // Elements move with what they own.
    if (sequence.maximum > 0) std::memcpy(grown, sequence.buffer, sequence.maximum * type.element->size);
    for (std::size_t i = sequence.maximum; i < length; ++i) Initialise(*type.element, grown + i * type.element->size);
    if (sequence.release != nullptr && sequence.buffer != nullptr) sequence.release(sequence.buffer);
    sequence.buffer = grown;
    sequence.maximum = length;
    sequence.release = std::free;
  }
  sequence.length = length;
  return true;
}

void Copy(const ValueType& type, void* to, const void* from) {
  void* const source = const_cast<void*>(from);  // Elements() and what is set are asked of it, it is not changed
  switch (type.kind) {
    case ValueKind::kOwnedText: {
      const char* const text = Load<const char*>(from);
      char* const copied = text != nullptr ? strdup(text) : nullptr;
      std::free(Load<char*>(to));
      std::memcpy(to, &copied, sizeof(copied));
      break;
    }
    case ValueKind::kList: type.list->copy(to, from); break;
    case ValueKind::kString:
      *static_cast<std::string*>(to) = *static_cast<const std::string*>(from);
      break;
    case ValueKind::kStruct:
      for (const ValueMember& each : type.members) Copy(*each.type, At(to, each.offset), At(from, each.offset));
      break;
    case ValueKind::kUnion: {
      Release(type, to);
      std::memcpy(to, from, type.element->size);
      if (const ValueMember* chosen = ChosenMember(type, to)) {
        Initialise(*chosen->type, At(to, chosen->offset));
        Copy(*chosen->type, At(to, chosen->offset), At(from, chosen->offset));
      }
      break;
    }
    case ValueKind::kOptional:
      std::memcpy(to, from, sizeof(bool));
      Copy(*type.element, At(to, type.element_offset), At(from, type.element_offset));
      break;
    case ValueKind::kArray: case ValueKind::kSequence: case ValueKind::kOwnedSequence: {
      const std::size_t length = LengthOf(type, from);
      if (type.kind != ValueKind::kArray && !Resize(type, to, static_cast<std::uint32_t>(length))) return;
      for (std::size_t i = 0; i < length; ++i) {
        Copy(*type.element, Elements(type, to) + i * type.element->size, Elements(type, source) + i * type.element->size);
      }
      break;
    }
    default: std::memcpy(to, from, type.size);
  }
}

}  // namespace runnel::genom_standalone
