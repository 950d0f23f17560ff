#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel::internal {

/// Appends what the entity means that `text` begins with ("&lt;…") to `resolved`; how many bytes the entity has.
/// Errors: what is wrong with it.
Result<std::size_t> ResolveEntity(std::string_view text, std::string& resolved);

/// The encoding that a declaration ("<?xml version=… encoding=…") names, if text in it is no UTF-8, as all
/// ASCII is; "" if it is, or none is named.
[[nodiscard]] std::string OtherEncoding(std::string_view declaration);

}  // namespace runnel::internal
