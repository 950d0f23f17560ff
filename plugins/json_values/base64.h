#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace runnel {

// Bytes as text (RFC 4648), which JSON has no other way for.

void AppendBase64(std::string_view bytes, std::string& text);
/// Nothing if it is none. The signs at the end may be missing.
[[nodiscard]] std::optional<std::string> FromBase64(std::string_view text);

}  // namespace runnel
