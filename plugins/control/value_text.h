#pragma once

#include <cstddef>
#include <string>

#include "core/types/type_info.h"

namespace runnel {

/// How much of a value is shown.
struct ValueTextOptions {
  std::size_t elements = 12;  ///< of a list; what comes after is only counted
  std::size_t string = 120;   ///< bytes of a text
  std::size_t all = 16'000;   ///< bytes of the whole; about
};
/// Lists and texts are not cut, but the whole is: after 4 MB.
[[nodiscard]] ValueTextOptions FullValueText();

/// The text format of a value as far as a person wants to see it: "[1, 2, 3, … 640 in all]". Takes time
/// and memory for what it shows only, however large the value is.
///
/// Threads:  as for the value. Allocates.
[[nodiscard]] std::string ValueText(const TypeInfo& type, const void* value,
                                    const ValueTextOptions& options = {});

}  // namespace runnel
