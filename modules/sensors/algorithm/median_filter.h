#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace runnel {

/// The median of each value and its `reach` neighbours on either side (fewer at the ends): takes
/// away single wrong values and leaves edges where they are. `values` and `filtered` have the same
/// size and do not overlap. Does not allocate. Precondition: reach <= kLargestReach.
/// NaN counts as farther than all numbers.
inline constexpr std::size_t kLargestReach = 7;

inline void MedianFilter(std::span<const float> values, std::size_t reach, std::span<float> filtered) {
  std::array<float, 2 * kLargestReach + 1> window{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    // The same number on either side, so that the median of a slope is its middle.
    const std::size_t on_a_side = std::min({reach, i, values.size() - 1 - i});
    const auto neighbours = values.subspan(i - on_a_side, 2 * on_a_side + 1);
    std::ranges::copy(neighbours, window.begin());
    const auto middle = window.begin() + static_cast<std::ptrdiff_t>(on_a_side);
    std::nth_element(window.begin(), middle, window.begin() + static_cast<std::ptrdiff_t>(neighbours.size()),
                     [](float a, float b) { return a < b || (std::isnan(b) && !std::isnan(a)); });
    filtered[i] = *middle;
  }
}

}  // namespace runnel
