#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace runnel {

/// How often each base unit is in a unit: m, g, s, A, K, rad.
using Dimensions = std::array<int, 6>;

/// One of it is `numerator / denominator` of the base units. A quotient, since 15 / 100 is 0.15 to the
/// last bit and 15 * 0.01 need not be.
struct Unit {
  double numerator = 1;
  double denominator = 1;
  Dimensions dimensions = {};
};

/// Units: m, s, min, h, rad, deg, °, rpm, Hz, g, t, N, J, W, Pa, A, V, K, %, with the prefixes k, M, G, d, c,
/// m, u, µ, n where they are usual; products and quotients of them with whole exponents: "m/s^2", "m/s²",
/// "N*m", "1/s". Nothing if it is none of these.
[[nodiscard]] std::optional<Unit> ParseUnit(std::string_view text);

/// How many of `to` is one of `from`, as a quotient; nothing if they are not of one kind.
struct UnitRatio {
  double numerator = 1;
  double denominator = 1;
};
[[nodiscard]] std::optional<UnitRatio> RatioOfUnits(std::string_view from, std::string_view to);

}  // namespace runnel
