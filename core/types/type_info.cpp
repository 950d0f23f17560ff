#include "core/types/type_info.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/base/ordered_mutex.h"
#include "core/types/type_builder.h"
#include "core/types/type_of.h"

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

/// Where the type descriptions of a process are: each plugin brings its own copy of TypeOf<T>(),
/// and all copies must come to the same TypeInfo.
///
/// Threads: any.
class TypeRegistry {
 public:
  [[nodiscard]] static TypeRegistry& Instance() {
    // Never destroyed: ports of static life may look at their types until the very end.
    static auto* registry = new TypeRegistry;
    return *registry;
  }

  /// The description of `cpp_type`, made by `describe` if it is the first time that somebody asks.
  /// `describe` may ask for further types, and even for this one.
  /// Errors: throws ProgrammingError if the description has no name or another type's, or if the type is
  /// known with another layout or description: a library that was built anew, and its values cannot be
  /// handed to the rest.
  const TypeInfo& Get(std::type_index cpp_type, const internal::TypeLayout& layout,
                      const std::function<void(TypeInfo&)>& describe);

  [[nodiscard]] const TypeInfo* Find(std::string_view name) const;
  [[nodiscard]] std::vector<const TypeInfo*> All() const;

 private:
  void CheckName(const TypeInfo& type) const;
  void CheckSame(const TypeInfo& known, const internal::TypeLayout& layout,
                 const std::function<void(TypeInfo&)>& describe);

  mutable OrderedMutex mutex_{LockLevel::kRegistry};
  std::map<std::type_index, std::unique_ptr<TypeInfo>> by_cpp_type_;
  std::map<std::string, const TypeInfo*, std::less<>> by_name_;
  std::multimap<std::type_index, std::unique_ptr<TypeInfo>> refused_;
  std::vector<const TypeInfo*> being_compared_;
};

void TypeRegistry::CheckName(const TypeInfo& type) const {
  RUNNEL_CHECK(!type.name().empty(), "the description of a type gives it a name");
  const auto taken = by_name_.find(type.name());
  if (taken == by_name_.end()) return;
  ThrowProgrammingError(
      "two types cannot have one name",
      "'" + type.name() + "' is " + taken->second->cpp_type().name() + " and " + type.cpp_type().name());
}

// Descriptions of types that contain each other come round to the first.
void TypeRegistry::CheckSame(const TypeInfo& known, const internal::TypeLayout& layout,
                             const std::function<void(TypeInfo&)>& describe) {
  if (!known.is_complete() || std::ranges::count(being_compared_, &known) > 0) return;
  const auto refuse = [&](const std::string& what) {
    ThrowProgrammingError("a library knows the type '" + known.name() + "' otherwise",
                          what + "; build it and what it is used with from the same source");
  };
  if (layout.size != known.size_ || layout.alignment != known.alignment_) {
    refuse("its values have " + std::to_string(layout.size) + " bytes there, and " + std::to_string(known.size_) +
           " elsewhere");
  }
  TypeInfo here(known.cpp_type());
  being_compared_.push_back(&known);
  try {
    describe(here);
  } catch (...) {
    being_compared_.pop_back();
    throw;
  }
  being_compared_.pop_back();
  // Fields of the same names may lie elsewhere, beside others that are not described.
  const std::shared_ptr<void> value = known.Make();
  const auto is_same_field = [&](const FieldInfo& a, const FieldInfo& b) {
    return a.name == b.name && a.type == b.type &&
           (value == nullptr || a.address(value.get()) == b.address(value.get()));
  };
  const auto is_same_value = [](const EnumeratorInfo& a, const EnumeratorInfo& b) {
    return a.name == b.name && a.value == b.value;
  };
  const bool is_same = here.name() == known.name() && here.kind() == known.kind() &&
                       here.semantic_tag() == known.semantic_tag() &&
                       std::ranges::equal(here.fields(), known.fields(), is_same_field) &&
                       std::ranges::equal(here.enumerators(), known.enumerators(), is_same_value);
  if (!is_same) refuse("its description is another one there");
}

const TypeInfo& TypeRegistry::Get(std::type_index cpp_type, const internal::TypeLayout& layout,
                                  const std::function<void(TypeInfo&)>& describe) {
  const std::lock_guard lock(mutex_);
  const auto known = by_cpp_type_.find(cpp_type);
  if (known != by_cpp_type_.end()) {
    CheckSame(*known->second, layout, describe);
    return *known->second;
  }
  const auto place = by_cpp_type_.emplace(cpp_type, std::make_unique<TypeInfo>(cpp_type)).first;
  TypeInfo& type = *place->second;
  type.size_ = layout.size;
  type.alignment_ = layout.alignment;
  try {
    describe(type);
    CheckName(type);
    by_name_.emplace(type.name(), &type);
  } catch (...) {
    // Kept, since descriptions made meanwhile (of lists of this type) may point to it.
    refused_.insert(by_cpp_type_.extract(place));
    throw;
  }
  type.is_complete_ = true;
  return type;
}

const TypeInfo* TypeRegistry::Find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

std::vector<const TypeInfo*> TypeRegistry::All() const {
  const std::lock_guard lock(mutex_);
  std::vector<const TypeInfo*> types;
  for (const auto& [name, type] : by_name_) types.push_back(type);
  return types;
}

namespace internal {

const TypeInfo& GetType(std::type_index cpp_type, const TypeLayout& layout, void (*describe)(TypeInfo&)) {
  return TypeRegistry::Instance().Get(cpp_type, layout, describe);
}

}  // namespace internal

const TypeInfo* FindType(std::string_view name) { return TypeRegistry::Instance().Find(name); }
std::vector<const TypeInfo*> RegisteredTypes() { return TypeRegistry::Instance().All(); }

}  // namespace runnel
