#pragma once

#include <string_view>

#include "core/types/value_tokens.h"

namespace runnel {

[[nodiscard]] std::string_view WithoutWhitespace(std::string_view text);

/// Takes apart a text format, whatever its type. Errors: what was expected, and before what.
[[nodiscard]] Result<ValueTokens> TokensOf(std::string_view text);

}  // namespace runnel
