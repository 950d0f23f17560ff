#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "core/types/builtin_types.h"
#include "core/types/leaf_types.h"
#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/cdr_values/internal/cdr_enumeration.h"

namespace runnel {

namespace {

void WriteTime(Duration since_begin, CdrWriter& writer) {
  using std::chrono::floor, std::chrono::seconds;
  constexpr std::numeric_limits<std::int32_t> kLimits;
  const auto whole = floor<seconds>(since_begin);
  const auto held = std::clamp<std::int64_t>(whole.count(), kLimits.min(), kLimits.max());
  writer.Put(static_cast<std::int32_t>(held));
  writer.Put(static_cast<std::uint32_t>((since_begin - whole).count()));
}

void WriteLeaf(const TypeInfo& type, const void* value, CdrWriter& writer) {
  if (&type == &TypeOf<Signal>()) return writer.Put(std::uint8_t{0});
  WithLeafType(type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_void_v<T>) {
      writer.PutText(type.leaf().to_text(value));
    } else if constexpr (std::is_same_v<T, std::string>) {
      writer.PutText(*static_cast<const T*>(value));
    } else if constexpr (std::is_same_v<T, Duration>) {
      WriteTime(*static_cast<const T*>(value), writer);
    } else if constexpr (std::is_same_v<T, Time>) {
      WriteTime(static_cast<const T*>(value)->time_since_epoch(), writer);
    } else {
      writer.Put(*static_cast<const T*>(value));
    }
  });
}

void WriteElements(const TypeInfo& type, const void* value, CdrWriter& writer) {
  const ElementOperations& elements = type.elements();
  const std::size_t rows = elements.rows(value), columns = elements.columns(value);
  if (!elements.is_fixed) {
    if (type.kind() == TypeKind::kMatrix) {
      writer.PutCount(rows);
      writer.PutCount(columns);
    }
    writer.PutCount(rows * columns);
  }
  void* const list = ForLooking(value);
  if (rows * columns == 0) return;
  if (elements.are_plain_numbers) {
    return writer.PutPlain(elements.element(list, 0), elements.type->size(), rows * columns);
  }
  for (std::size_t i = 0; i < rows * columns; ++i) {
    WriteCdr(*elements.type, elements.element(list, i), writer);
  }
}

}  // namespace

void WriteCdr(const TypeInfo& type, const void* value, CdrWriter& writer) {
  switch (type.kind()) {
    case TypeKind::kOpaque:
      break;
    case TypeKind::kLeaf:
      return WriteLeaf(type, value, writer);
    case TypeKind::kEnumeration:
      return internal::WithEnumerationType(
          type, [&]<typename N>(std::type_identity<N>) { writer.Put(static_cast<N>(type.enumeration().get(value))); });
    case TypeKind::kStructure:
      for (const FieldInfo& field : type.fields()) {
        WriteCdr(*field.type, field.address(ForLooking(value)), writer);
      }
      return;
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return WriteElements(type, value, writer);
  }
  ThrowProgrammingError("an opaque value has no octets", type.name());
}

void WriteCdr(const TypeInfo& type, const void* value, std::vector<std::byte>& octets) {
  CdrWriter writer(octets);
  WriteCdr(type, value, writer);
}

Result<void> CheckCdr(const TypeInfo& type) {
  if (type.is_transparent()) return {};
  return Error{
      .message = "a " + type.name() + " cannot go over the network: its inside, or a part of it, is not described",
      .hint = "Describe() of the type is to name its fields"};
}

}  // namespace runnel
