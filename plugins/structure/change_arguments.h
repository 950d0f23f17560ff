#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"

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

/// The arguments of one change, taken one after the other. What is missing or wrong is remembered, the first
/// of it, so that readers read straight on. The line must outlive it.
class Arguments {
 public:
  Arguments(const ChangeLine& line, std::string usage) : line_(line), usage_(std::move(usage)) {}

  std::string Take(const char* what) {
    if (at_ < line_.size()) return line_[at_++].text;
    const ChangeArgument& last = line_.back();
    Complain(last.position, std::string(what) + " is missing after '" + last.text + "'", "write: " + usage_);
    return {};
  }
  [[nodiscard]] const std::string& verb() const { return line_.front().text; }
  [[nodiscard]] bool IsAtEnd() const { return at_ == line_.size(); }
  bool TakeIf(std::string_view text) { return at_ < line_.size() && line_[at_].text == text && ++at_ > 0; }
  void Expect(const std::string& text) {
    const ChangeArgument* argument = at_ < line_.size() ? &line_[at_] : nullptr;
    const std::string found = Take(("'" + text + "'").c_str());
    if (argument != nullptr && found != text) {
      Complain(argument->position, "there should be '" + text + "' instead of '" + found + "'", "write: " + usage_);
    }
  }
  /// All that is left, one at least, but for options.
  std::vector<std::string> TakeWords(const char* what) {
    std::vector<std::string> words{Take(what)};
    while (at_ < line_.size() && !line_[at_].equals) words.push_back(line_[at_++].text);
    return words;
  }
  std::size_t TakeOneOf(const char* what, const std::vector<std::string>& names) {
    const ChangeArgument* argument = at_ < line_.size() ? &line_[at_] : nullptr;
    const std::string found = Take(what);
    return argument != nullptr ? Choose(*argument, found, names) : 0;
  }
  /// The rest, all "name=value", goes to `take`, which says whether it has been interested.
  template <typename TakeOption>
  void TakeOptions(const std::vector<std::string>& names, const TakeOption& take) {
    std::vector<std::string> seen;
    for (; at_ < line_.size(); ++at_) {
      const ChangeArgument& argument = line_[at_];
      if (!argument.equals || *argument.equals == 0) {
        Complain(argument.position, "'" + argument.text + "' is one word too many", "write: " + usage_);
      } else if (std::ranges::count(seen, argument.name()) > 0) {
        Complain(argument.position, "'" + argument.name() + "' is there twice", "leave one of them out");
      } else if (!take(argument)) {
        Complain(argument.position, "there is no option '" + argument.name() + "'",
                 NearestNameHint(argument.name(), names));
      }
      seen.push_back(argument.name());
    }
  }
  /// What is left has no meaning.
  void End() {
    TakeOptions({}, [](const ChangeArgument&) { return false; });
  }

  std::size_t Choose(const ChangeArgument& argument, const std::string& value, const std::vector<std::string>& names) {
    const auto found = std::ranges::find(names, value);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    Complain(argument.position, "'" + value + "' is none of the words that can stand here",
             NearestNameHint(value, names));
    return 0;
  }
  template <typename Number>
  Number ReadCount(const ChangeArgument& argument, Number largest) {
    const std::string text = argument.value();
    const auto number = NumberIn<Number>(text);
    if (number && *number <= largest) return *number;
    Complain(argument.position, "'" + text + "' is not a count for '" + argument.name() + "'",
             "write a whole number from 0 to " + std::to_string(largest));
    return {};
  }
  void Complain(const SourcePosition& position, std::string message, std::string hint) {
    if (!error_) {
      error_ = Error{.message = std::move(message), .position = position, .hint = std::move(hint)};
    }
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  const ChangeLine& line_;
  const std::string usage_;
  std::size_t at_ = 1;
  std::optional<Error> error_;
};

}  // namespace runnel::internal
