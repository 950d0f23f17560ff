#include "core/types/value_copy.h"

#include <algorithm>
#include <cstring>

#include "core/base/check.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

bool CopyElements(const ElementOperations& elements, const void* from, void* to) {
  const std::size_t rows = elements.rows(from);
  const std::size_t columns = elements.columns(from);
  if (!elements.resize(to, rows, columns)) return false;
  const std::size_t count = rows * columns;
  if (elements.are_plain_numbers) {
    if (count == 0) return true;
    std::memcpy(elements.element(to, 0), elements.element(ForLooking(from), 0), count * elements.type->size());
    return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const void* const element = elements.element(ForLooking(from), i);
    if (!CopyValue(*elements.type, element, elements.element(to, i))) return false;
  }
  return true;
}

}  // namespace

bool CopyValue(const TypeInfo& type, const void* from, void* to) {
  switch (type.kind()) {
    case TypeKind::kOpaque:
      break;
    case TypeKind::kLeaf:
      type.leaf().copy(to, from);
      return true;
    case TypeKind::kEnumeration:
      type.enumeration().set(to, type.enumeration().get(from));
      return true;
    case TypeKind::kStructure:
      return std::ranges::all_of(type.fields(), [&](const FieldInfo& field) {
        return CopyValue(*field.type, field.address(ForLooking(from)), field.address(to));
      });
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      return CopyElements(type.elements(), from, to);
  }
  ThrowProgrammingError("an opaque value cannot be copied by its description", type.name());
}

}  // namespace runnel
