#pragma once

#include <map>

#include "plugins/genom_description/type.h"

namespace runnel::genom {

/// How much memory a value takes as codels in C see it, on 64 bits.
struct Layout {
  std::uint64_t size = 0;
  std::uint64_t alignment = 1;
};

/// Computes layouts, each once. Sizes that 64 bits do not hold are the largest that they do.
class Layouts {
 public:
  [[nodiscard]] Layout Of(const Type& type);
  /// Of what stands side by side: where each member begins is added to `offsets`.
  [[nodiscard]] Layout OfMembers(const std::vector<Type*>& members, std::vector<std::uint64_t>* offsets = nullptr);

 private:
  static constexpr int kDeepest = 1000;
  [[nodiscard]] Layout Compute(const Type& type);
  std::map<const Type*, Layout> known_ = {};
  int depth_ = 0;
};

}  // namespace runnel::genom
