#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <vector>

#include "core/base/ordered_mutex.h"
#include "core/types/type_info.h"

namespace runnel {

namespace internal {
struct TypeLayout;
}  // namespace internal

/// Where the type descriptions of a process are: each plugin brings its own copy of TypeOf<T>(),
/// and all copies must come to the same TypeInfo.
///
/// Threads: any.
class TypeRegistry {
 public:
  [[nodiscard]] static TypeRegistry& Instance();

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

}  // namespace runnel
