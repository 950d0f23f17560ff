#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// A number with a unit, "15 cm", as text of the same number in another unit: "0.15" in "m". A number
/// without a unit is returned as it is, and so is a text that is no number; whoever reads it says why.
///
/// Units: m, s, min, h, rad, deg, °, rpm, Hz, g, t, N, J, W, Pa, A, V, K, %, with the prefixes k, M, G, d, c,
/// m, u, µ, n where they are usual; products and quotients of them with whole exponents: "m/s^2", "m/s²",
/// "N*m", "1/s". Any other unit of a parameter is taken when it is written just so.
///
/// Errors: a unit that is none, or one of something else than `unit`; the hint names `unit`.
[[nodiscard]] Result<std::string> NumberInUnit(std::string_view text, std::string_view unit);

}  // namespace runnel
