#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostics.h"

namespace runnel::internal {

/// One argument of a change in text format, without the quotation marks that it may have had.
struct ChangeArgument {
  std::string text = {};
  /// Where the first '=' outside of quotation marks is: of "name=value", the end of the name.
  std::optional<std::size_t> equals = {};
  SourcePosition position = {};

  [[nodiscard]] std::string name() const { return text.substr(0, equals.value_or(text.size())); }
  [[nodiscard]] std::string value() const { return equals ? text.substr(*equals + 1) : ""; }
};

/// The arguments of one change; never empty.
using ChangeLine = std::vector<ChangeArgument>;

/// Splits a text into changes, by ends of lines and semicolons, and those into arguments, by whitespace. `begins`
/// is where the text begins in a file. Lines with errors are left out.
[[nodiscard]] std::vector<ChangeLine> SplitChanges(std::string_view text, const SourcePosition& begins,
                                                   Diagnostics& diagnostics);

/// `text` as an argument that is read back as it is: in quotation marks where it needs them.
[[nodiscard]] std::string AsArgument(std::string_view text);

}  // namespace runnel::internal
