#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace runnel {

class TypeInfo;

/// How many bytes a value has, an object of the type: its fields, and the elements of its lists and the letters of its
/// texts instead of what keeps them; without gaps between fields. What an opaque type has is its size.
///
/// Threads:  as for the object. Allocates nothing; lists are walked through only where their elements have lists.
[[nodiscard]] std::size_t BytesOf(const TypeInfo& type, const void* value);

// Bytes as text (RFC 4648), which JSON has no other way for.

void AppendBase64(std::string_view bytes, std::string& text);
/// The bytes of a list, an object of the type, in quotation marks.
void AppendBase64(const TypeInfo& list, const void* value, std::string& json);
/// Nothing if it is none. The signs at the end may be missing.
[[nodiscard]] std::optional<std::string> FromBase64(std::string_view text);

}  // namespace runnel
