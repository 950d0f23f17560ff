#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/base/shared_vector.h"
#include "core/types/builtin_types.h"
#include "core/types/leaf_types.h"
#include "core/types/type_builder.h"

namespace runnel {

/// As any list of numbers: "shared uint8[]". Who writes elements by the description resizes the list first, if to the size
/// that it has: then they are its own.
template <typename E>
void Describe(TypeBuilder<SharedVector<E>>& type) {
  using List = SharedVector<E>;
  type.Name("shared " + TypeOf<E>().name() + "[]")
      .Elements(TypeKind::kSequence, {.type = &TypeOf<E>(),
                                      .columns = [](const void* at) { return static_cast<const List*>(at)->size(); },
                                      .resize =
                                          [](void* at, std::size_t, std::size_t columns) {
                                            static_cast<List*>(at)->resize(columns);
                                            return true;
                                          },
                                      .element = [](void* at, std::size_t index) -> void* {
                                        return ForLooking(std::as_const(*static_cast<List*>(at)).data() + index);
                                      },
                                      .are_plain_numbers = true});
}

/// Has `list`, if it is a SharedVector, look at `count` numbers of its kind from `first` on, which stay as they are as long
/// as anybody has `holder`. False if it is none, or they are not aligned as such numbers are: then nothing has changed.
[[nodiscard]] inline bool ReferTo(const TypeInfo& type, void* list, const void* first, std::size_t count,
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
