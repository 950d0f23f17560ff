#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace runnel {

class TypeInfo;

// Bytes as text (RFC 4648), which JSON has no other way for.

void AppendBase64(std::string_view bytes, std::string& text);
/// The bytes of a list, an object of the type, in quotation marks.
void AppendBase64(const TypeInfo& list, const void* value, std::string& json);
/// Nothing if it is none. The signs at the end may be missing.
[[nodiscard]] std::optional<std::string> FromBase64(std::string_view text);

}  // namespace runnel
