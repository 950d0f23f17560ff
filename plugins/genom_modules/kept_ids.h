#pragma once

#include <cstddef>

#include "core/types/type_of.h"
#include "plugins/genom_modules/codel_values.h"
#include "plugins/genom_modules/views.h"

namespace runnel::genom_modules {

/// The ids of a component in C++, whose lists and texts are other classes than those of their view, as what its module
/// leaves to the one that takes its place (Module::KeepState()): a copy within a library, else by the description of the view.
///
/// Threads: as the ids; handed over while nobody uses them.
template <typename View, typename Ids>
struct KeptIds {
  explicit KeptIds(Ids& of) : ids(&of) {}
  KeptIds(const KeptIds&) = delete;
  KeptIds& operator=(const KeptIds& from) {
    *ids = *from.ids;
    return *this;
  }
  ~KeptIds() = default;

  Ids* ids;
  View view{};  // what they are on their way
  View end{};
};

/// A list of two: the view, and something empty, which is asked for when the view has been written.
template <typename View, typename Ids>
void Describe(TypeBuilder<KeptIds<View, Ids>>& type) {
  using Kept = KeptIds<View, Ids>;
  type.Name("kept " + TypeOf<View>().name());
  type.Elements(TypeKind::kSequence, {.type = &TypeOf<View>(),
                                      .is_fixed = true,
                                      .columns = [](const void*) -> std::size_t { return 2; },
                                      .resize = [](void*, std::size_t, std::size_t columns) { return columns == 2; },
                                      .element = [](void* at, std::size_t index) -> void* {
                                        using genom_execution::ToCodel;
                                        using genom_execution::ToView;
                                        Kept& kept = *static_cast<Kept*>(at);
                                        if (index == 0) {
                                          ToView(kept.view, *kept.ids);
                                          return &kept.view;
                                        }
                                        ToCodel(*kept.ids, kept.view);
                                        kept.view = View{};
                                        return &kept.end;
                                      }});
}

}  // namespace runnel::genom_modules
