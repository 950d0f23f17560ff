#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "core/base/shared_vector.h"
#include "core/types/builtin_types.h"
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
[[nodiscard]] bool ReferTo(const TypeInfo& type, void* list, const void* first, std::size_t count,
                           const std::shared_ptr<const void>& holder);

}  // namespace runnel
