#include "core/types/shared_vector_types.h"

#include <cstdint>
#include <type_traits>

#include "core/types/leaf_types.h"

namespace runnel {

bool ReferTo(const TypeInfo& type, void* list, const void* first, std::size_t count,
             const std::shared_ptr<const void>& holder) {
  if (!type.elements().are_plain_numbers || type.elements().is_fixed) return false;
  return WithLeafType(*type.elements().type, [&]<typename T>(std::type_identity<T>) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (type.cpp_type() != typeid(SharedVector<T>)) return false;
      if (reinterpret_cast<std::uintptr_t>(first) % alignof(T) != 0) return false;
      static_cast<SharedVector<T>*>(list)->ReferTo(static_cast<const T*>(first), count, holder);
      return true;
    } else {
      return false;
    }
  });
}

}  // namespace runnel
