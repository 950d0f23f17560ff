#include "core/types/internal/type_registry.h"

#include <mutex>

#include "core/base/check.h"
#include "core/types/type_of.h"

namespace runnel {

TypeRegistry& TypeRegistry::Instance() {
  // Never destroyed: ports of static life may look at their types until the very end.
  static auto* registry = new TypeRegistry;
  return *registry;
}

void TypeRegistry::CheckName(const TypeInfo& type) const {
  RUNNEL_CHECK(!type.name().empty(), "the description of a type gives it a name");
  const auto taken = by_name_.find(type.name());
  if (taken == by_name_.end()) return;
  ThrowProgrammingError("two types cannot have one name", "'" + type.name() + "' is " +
                                                              taken->second->cpp_type().name() +
                                                              " and " + type.cpp_type().name());
}

const TypeInfo& TypeRegistry::Get(std::type_index cpp_type,
                                  const std::function<void(TypeInfo&)>& describe) {
  const std::lock_guard lock(mutex_);
  const auto [place, is_new] = by_cpp_type_.try_emplace(cpp_type);
  if (!is_new) return *place->second;
  place->second = std::make_unique<TypeInfo>(cpp_type);
  TypeInfo& type = *place->second;
  try {
    describe(type);
    CheckName(type);
  } catch (...) {
    // Kept, since descriptions made meanwhile (of lists of this type) may point to it.
    refused_.push_back(std::move(place->second));
    by_cpp_type_.erase(place);
    throw;
  }
  type.is_complete_ = true;
  by_name_.emplace(type.name(), &type);
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

const TypeInfo& GetType(std::type_index cpp_type, void (*describe)(TypeInfo&)) {
  return TypeRegistry::Instance().Get(cpp_type, describe);
}

}  // namespace internal

const TypeInfo* FindType(std::string_view name) { return TypeRegistry::Instance().Find(name); }
std::vector<const TypeInfo*> RegisteredTypes() { return TypeRegistry::Instance().All(); }

}  // namespace runnel
