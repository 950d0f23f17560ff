#include "core/types/binary_encoding.h"

#include "core/types/internal/parts.h"
#include "core/types/internal/reading_limits.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

std::size_t CountOf(const ElementOperations& elements, const void* value) {
  return elements.rows(value) * elements.columns(value);
}

// Precondition: the type is transparent.
void Write(const TypeInfo& type, const void* value, BinaryWriter& writer);

void WriteElements(const TypeInfo& type, const void* value, BinaryWriter& writer) {
  const ElementOperations& elements = type.elements();
  if (!elements.is_fixed) {
    if (type.kind() == TypeKind::kMatrix) {
      writer.WriteUnsigned(static_cast<std::uint32_t>(elements.rows(value)));
    }
    writer.WriteUnsigned(static_cast<std::uint32_t>(elements.columns(value)));
  }
  for (std::size_t i = 0; i < CountOf(elements, value); ++i) {
    Write(*elements.type, elements.element(ForLooking(value), i), writer);
  }
}

void Write(const TypeInfo& type, const void* value, BinaryWriter& writer) {
  switch (type.kind()) {
    case TypeKind::kOpaque:
      return;
    case TypeKind::kLeaf:
      return type.leaf().write(value, writer);
    case TypeKind::kEnumeration:
      return writer.WriteUnsigned(static_cast<std::uint64_t>(type.enumeration().get(value)));
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        Write(*field.type, field.address(ForLooking(value)), writer);
      }
      return;
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return WriteElements(type, value, writer);
  }
}

bool Read(const TypeInfo& type, BinaryReader& reader, ReadingLimits& limits, void* value);

// Each element takes a byte at least, so a count beyond what is left is a lie that must not make
// anybody allocate; nor must many large ones that take a byte each.
bool ReadShape(const TypeInfo& type, BinaryReader& reader, ReadingLimits& limits, void* value) {
  const ElementOperations& elements = type.elements();
  if (elements.is_fixed) return true;
  std::uint32_t rows = 1, columns = 0;
  if (type.kind() == TypeKind::kMatrix && !reader.ReadUnsigned(rows)) return false;
  if (!reader.ReadUnsigned(columns)) return false;
  if (std::uint64_t{rows} * columns > reader.remaining()) return false;
  if (!limits.Take(std::size_t{rows} * columns, elements.type->size())) return false;
  return elements.resize(value, rows, columns);
}

bool ReadElements(const TypeInfo& type, BinaryReader& reader, ReadingLimits& limits, void* value) {
  if (!ReadShape(type, reader, limits, value)) return false;
  const ElementOperations& elements = type.elements();
  for (std::size_t i = 0; i < CountOf(elements, value); ++i) {
    if (!Read(*elements.type, reader, limits, elements.element(value, i))) return false;
  }
  return true;
}

bool ReadEnumeration(const TypeInfo& type, BinaryReader& reader, void* value) {
  std::uint64_t number = 0;
  if (!reader.ReadUnsigned(number)) return false;
  for (const EnumeratorInfo& each : type.enumerators()) {
    if (each.value != static_cast<std::int64_t>(number)) continue;
    type.enumeration().set(value, each.value);
    return true;
  }
  return false;
}

bool Read(const TypeInfo& type, BinaryReader& reader, ReadingLimits& limits, void* value) {
  const ReadingLimits::Level level(limits);
  if (level.is_too_deep()) return false;
  switch (type.kind()) {
    case TypeKind::kOpaque:
      return false;
    case TypeKind::kLeaf:
      return type.leaf().read(reader, value);
    case TypeKind::kEnumeration:
      return ReadEnumeration(type, reader, value);
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        if (!Read(*field.type, reader, limits, field.address(value))) return false;
      }
      return true;
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return ReadElements(type, reader, limits, value);
  }
  return false;
}

Error NoBinaryEncoding(const TypeInfo& type) {
  return {.message = "a " + type.name() + " has no binary encoding: its inside is not described"};
}

}  // namespace

Result<void> ToBinary(const TypeInfo& type, const void* value, std::vector<std::byte>& bytes) {
  if (!type.is_transparent()) return NoBinaryEncoding(type);
  BinaryWriter writer(bytes);
  Write(type, value, writer);
  return {};
}

Result<void> FromBinary(const TypeInfo& type, BinaryReader& reader, void* value) {
  if (!type.is_transparent()) return NoBinaryEncoding(type);
  ReadingLimits limits;
  if (!Read(type, reader, limits, value)) {
    return Error{.message = "these bytes are no " + type.name()};
  }
  return {};
}

}  // namespace runnel
