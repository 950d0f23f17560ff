#pragma once

#include <cstddef>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "core/element/annotation.h"

namespace runnel {

/// What a module remembers from cycle to cycle and leaves to a module that takes its place, if that
/// remembers something of the same type. Filled by Module::KeepState().
///
/// Ownership:  of nothing; the states are members of the module.
/// Threads:    handed over while neither of the two modules runs.
class KeptState final : public Annotation {
 public:
  template <typename State>
  void Add(State& state) {
    parts_.push_back({typeid(State).name(), sizeof(State), alignof(State), &state,
                      [](void* to, const void* from) {
                        *static_cast<State*>(to) = *static_cast<const State*>(from);
                      }});
  }

  /// Copies each part of `from` to the part of the same type here, the first to the first. Returns how
  /// many there were. Types are the same if name, size and alignment are: a library that was built anew
  /// may bring another type of the same name. Throws what copying throws.
  std::size_t TakeOver(const KeptState& from) {
    std::size_t taken = 0;
    std::vector<bool> used(from.parts_.size());
    for (const Part& part : parts_) {
      for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] || !part.IsLike(from.parts_[i])) continue;
        part.copy(part.state, from.parts_[i].state);
        used[i] = true;
        ++taken;
        break;
      }
    }
    return taken;
  }

 private:
  struct Part {
    std::string_view type;
    std::size_t size;
    std::size_t alignment;
    void* state;
    void (*copy)(void* to, const void* from);

    [[nodiscard]] bool IsLike(const Part& other) const noexcept {
      return type == other.type && size == other.size && alignment == other.alignment;
    }
  };
  std::vector<Part> parts_;
};

}  // namespace runnel
