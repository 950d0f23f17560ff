#pragma once

#include <string_view>

#include "modules/planning/algorithm/bug_variants.h"

namespace runnel {

/// The index of the variant called so, size() if there is none.
[[nodiscard]] constexpr std::size_t VariantIndex(std::string_view name) {
  std::size_t i = 0;
  while (i < kBugVariants.size() && kBugVariants[i].name != name) ++i;
  return i;
}

}  // namespace runnel
