#include "core/types/type_info.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/base/check.h"
#include "core/types/type_builder.h"

namespace runnel {

namespace {

bool IsCapital(char c) { return c >= 'A' && c <= 'Z'; }

// Types may contain themselves (a tree has a list of trees), so those that have been looked at are kept.
bool IsAnyPart(const TypeInfo& type, bool (*is_meant)(const TypeInfo& part), std::vector<const TypeInfo*>& known) {
  if (std::ranges::find(known, &type) != known.end()) return false;
  known.push_back(&type);
  if (is_meant(type)) return true;
  const TypeInfo* const element = type.elements().type;
  return (element != nullptr && IsAnyPart(*element, is_meant, known)) ||
         std::ranges::any_of(type.fields(),
                             [&](const FieldInfo& field) { return IsAnyPart(*field.type, is_meant, known); });
}

}  // namespace

bool TypeInfo::HasPart(bool (*is_meant)(const TypeInfo& part)) const {
  std::vector<const TypeInfo*> known;
  return IsAnyPart(*this, is_meant, known);
}

bool TypeInfo::is_transparent() const {
  return !HasPart([](const TypeInfo& part) { return part.kind() == TypeKind::kOpaque; });
}

const FieldInfo* TypeInfo::FindField(std::string_view name) const {
  const auto found = std::ranges::find(fields_, name, &FieldInfo::name);
  return found == fields_.end() ? nullptr : &*found;
}

std::shared_ptr<void> TypeInfo::Make() const {
  if (make_ == nullptr) return nullptr;
  return {make_(), delete_};
}

void TypeInfo::AddField(std::string&& name, const TypeInfo& type, FieldOptions&& options, const FieldAddress& address) {
  kind_ = TypeKind::kStructure;
  fields_.push_back({std::move(name), &type, std::move(options.unit), std::move(options.description), address});
}

namespace internal {

std::string NameIn(std::string_view function) {
  std::string_view own = function.substr(function.rfind(':') + 1);
  own.remove_suffix(own.ends_with("_]") ? 2 : 1);
  if (!own.starts_with('k') || own.size() == 1 || !IsCapital(own[1])) return std::string(own);
  own.remove_prefix(1);
  std::string name;
  for (const char c : own) {
    if (IsCapital(c) && !name.empty()) name += '_';
    name += IsCapital(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return name;
}

}  // namespace internal

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
