#include "plugins/values/value_bytes.h"

#include <algorithm>
#include <string>

#include "core/types/builtin_types.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

bool IsTold(const TypeInfo& type) { return type.kind() == TypeKind::kLeaf || type.kind() == TypeKind::kEnumeration; }

// Whether values of the type may differ in their bytes. A type can contain itself only in lists, where this ends.
bool Varies(const TypeInfo& type) {
  switch (type.kind()) {
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return !type.elements().is_fixed || Varies(*type.elements().type);
    case TypeKind::kStructure:
      return std::ranges::any_of(type.fields(), [](const FieldInfo& field) { return Varies(*field.type); });
    default:
      return &type == &TypeOf<std::string>();
  }
}

std::size_t BytesOfElements(const TypeInfo& type, const void* value) {
  const ElementOperations& elements = type.elements();
  const std::size_t count = elements.rows(value) * elements.columns(value);
  if (count == 0) return 0;
  if (IsTold(*elements.type) && elements.type != &TypeOf<std::string>()) {
    return count * elements.type->size();
  }
  const auto bytes_at = [&](std::size_t i) { return BytesOf(*elements.type, elements.element(ForLooking(value), i)); };
  if (!Varies(*elements.type)) return count * bytes_at(0);
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < count; ++i) bytes += bytes_at(i);
  return bytes;
}

}  // namespace

std::size_t BytesOf(const TypeInfo& type, const void* value) {
  if (&type == &TypeOf<std::string>()) return static_cast<const std::string*>(value)->size();
  switch (type.kind()) {
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return BytesOfElements(type, value);
    case TypeKind::kStructure: {
      std::size_t bytes = 0;
      for (const FieldInfo& field : type.fields()) {
        bytes += BytesOf(*field.type, field.address(ForLooking(value)));
      }
      return bytes;
    }
    default:
      return type.size();
  }
}

}  // namespace runnel
