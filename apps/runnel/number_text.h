#pragma once

#include <string>

namespace runnel::program {

/// Three digits, or all those before the point: "0.05", "9.81", "1300"; no exponent for what is
/// large.
[[nodiscard]] std::string NumberText(double number);

}  // namespace runnel::program
