#include "core/types/type_info.h"

#include <algorithm>
#include <utility>

#include "core/types/type_builder.h"

namespace runnel {

namespace {

// Types may contain themselves (a tree has a list of trees), so those being looked at are kept.
bool IsTransparent(const TypeInfo& type, std::vector<const TypeInfo*>& open) {
  if (std::ranges::find(open, &type) != open.end()) return true;
  open.push_back(&type);
  bool transparent = type.kind() != TypeKind::kOpaque;
  if (type.kind() == TypeKind::kStructure) {
    transparent = std::ranges::all_of(
        type.fields(), [&](const FieldInfo& field) { return IsTransparent(*field.type, open); });
  } else if (type.kind() == TypeKind::kSequence || type.kind() == TypeKind::kMatrix) {
    transparent = IsTransparent(*type.elements().type, open);
  }
  open.pop_back();
  return transparent;
}

}  // namespace

bool TypeInfo::is_transparent() const {
  std::vector<const TypeInfo*> open;
  return IsTransparent(*this, open);
}

const FieldInfo* TypeInfo::FindField(std::string_view name) const {
  const auto found = std::ranges::find(fields_, name, &FieldInfo::name);
  return found == fields_.end() ? nullptr : &*found;
}

std::shared_ptr<void> TypeInfo::Make() const {
  if (make_ == nullptr) return nullptr;
  return {make_(), delete_};
}

void TypeInfo::AddField(std::string&& name, const TypeInfo& type, FieldOptions&& options,
                        const FieldAddress& address) {
  kind_ = TypeKind::kStructure;
  fields_.push_back(
      {std::move(name), &type, std::move(options.unit), std::move(options.description), address});
}

}  // namespace runnel
