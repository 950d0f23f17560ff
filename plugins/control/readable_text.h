#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// Values in text format with their numbers as people read them: six significant digits. Whole numbers, and what stands in
/// quotation marks, stay as they are.
[[nodiscard]] std::string ReadableNumbers(std::string_view text);

}  // namespace runnel
