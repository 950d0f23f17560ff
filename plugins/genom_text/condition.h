#pragma once

#include <optional>
#include <vector>

#include "plugins/genom_text/text_token.h"

namespace runnel::genom {

/// The value of an expression behind #if, macros expanded and `defined` answered; nullopt if it is wrong, which has then
/// been told.
[[nodiscard]] std::optional<bool> ConditionValue(const std::vector<TextToken>& tokens, Place place,
                                                 Problems& problems);

}  // namespace runnel::genom
