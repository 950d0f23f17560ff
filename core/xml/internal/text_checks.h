#pragma once

#include <string>
#include <string_view>

namespace runnel::internal {

/// What is wrong with the entity that `text` begins with ("&lt;…"), "" if nothing is.
[[nodiscard]] std::string EntityFault(std::string_view text);

/// What a declaration ("<?xml version=… encoding=…") says of the encoding, "" if nothing.
[[nodiscard]] std::string DeclaredEncoding(std::string_view declaration);

/// Whether text of that encoding is UTF-8, as all ASCII is. "" stands for UTF-8.
[[nodiscard]] bool IsReadableEncoding(std::string_view encoding);

}  // namespace runnel::internal
