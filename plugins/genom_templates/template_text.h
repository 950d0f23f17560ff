#pragma once

#include <string>

#include "core/base/result.h"

namespace runnel::genom {

/// A template's text as a program in Lua that writes it: what stands in `<% … %>` is run, what stands in `<%= … %>` is
/// computed and written. A line that holds nothing but scripts leaves no line. Each line of the program is that line of
/// the template, so that places in Lua's messages are right.
///
/// Errors: a marker without its other half; the position has line and column, and no file.
[[nodiscard]] Result<std::string> ProgramOf(const std::string& text);

}  // namespace runnel::genom
