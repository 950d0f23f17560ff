#pragma once

#include <cstdint>
#include <type_traits>

#include "core/types/type_info.h"

namespace runnel::internal {

/// Calls `use` with the unsigned number that is as large as the enumeration, as a std::type_identity.
template <typename Use>
auto WithEnumerationType(const TypeInfo& type, const Use& use) {
  switch (type.size()) {
    case 1:
      return use(std::type_identity<std::uint8_t>());
    case 2:
      return use(std::type_identity<std::uint16_t>());
    case 4:
      return use(std::type_identity<std::uint32_t>());
    default:
      return use(std::type_identity<std::uint64_t>());
  }
}

}  // namespace runnel::internal
