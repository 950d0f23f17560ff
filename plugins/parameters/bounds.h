#pragma once

#include <optional>
#include <type_traits>

namespace runnel {

/// The closed interval that a value must lie in; either end may be missing.
template <typename T>
struct Bounds {
  std::optional<T> lowest = {};
  std::optional<T> highest = {};

  [[nodiscard]] bool Contain(const T& value) const {
    // Written so that NaN, which compares with nothing, is outside of any bound.
    return (!lowest || value >= *lowest) && (!highest || value <= *highest);
  }
  [[nodiscard]] bool empty() const { return !lowest && !highest; }
};

/// Numbers have bounds, other types have none.
template <typename T>
concept Bounded = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

}  // namespace runnel
