#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// `text` with what a terminal would not show but obey, and what is no UTF-8, as "\x1b", but for the characters in `kept`.
/// For what others have written. Threads: any. Allocates.
[[nodiscard]] std::string Printable(std::string_view text, std::string_view kept = {});

}  // namespace runnel
