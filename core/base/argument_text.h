#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"

namespace runnel::internal {

/// One word of a line, without the quotation marks that it may have had.
struct TextArgument {
  std::string text = {};
  /// Where the first '=' outside of quotation marks is: of "name=value", the end of the name.
  std::optional<std::size_t> equals = {};
  SourcePosition position = {};

  [[nodiscard]] std::string name() const { return text.substr(0, equals.value_or(text.size())); }
  [[nodiscard]] std::string value() const { return equals ? text.substr(*equals + 1) : ""; }
};

/// Those of one line; never empty.
using ArgumentLine = std::vector<TextArgument>;

/// Splits a text into lines, by their ends and by semicolons, and those into arguments, by whitespace, but for what stands
/// in quotation marks or brackets; '#' begins a comment. `begins` is where the text begins in a file. Lines with errors are left out.
[[nodiscard]] std::vector<ArgumentLine> SplitArguments(std::string_view text, const SourcePosition& begins,
                                                       Diagnostics& diagnostics);

/// `text` as an argument that is read back as it is: in quotation marks where it needs them.
[[nodiscard]] std::string AsArgument(std::string_view text);

}  // namespace runnel::internal
