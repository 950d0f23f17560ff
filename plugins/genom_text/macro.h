#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plugins/genom_text/place.h"

namespace runnel::genom {

struct Macro {
  std::string name;
  Place place = {};
  bool has_parameters = false;
  bool is_variadic = false;  ///< the last parameter takes all that remains
  std::vector<std::string> parameters = {};
  std::vector<TextToken> body = {};
};

/// The macros of a description, and their expansion.
class MacroTable {
 public:
  explicit MacroTable(Problems& problems) : problems_(problems) {}

  /// What stands behind #define, without the newline.
  void Define(const std::vector<TextToken>& line, Place place);
  /// "NAME" or "NAME=VALUE".
  void DefineByText(const std::string& text);
  void Undefine(const std::string& name) { macros_.erase(name); }
  [[nodiscard]] bool Has(const std::string& name) const;

  /// Gives what follows a word in the file; kEnd when there is nothing more.
  using Source = std::function<TextToken()>;

  /// What becomes of `word`. Arguments that are not in the expansion itself come from `source`, and a token more may.
  [[nodiscard]] std::vector<TextToken> Expand(const TextToken& word, const Source& source);
  [[nodiscard]] std::vector<TextToken> ExpandAll(const std::vector<TextToken>& tokens);

 private:
  static constexpr std::size_t kMostSteps = 500'000;
  static constexpr int kDeepest = 64;
  using Arguments = std::vector<std::vector<TextToken>>;
  class Stream;

  [[nodiscard]] std::vector<TextToken> ExpandStream(Stream& stream);
  [[nodiscard]] std::optional<Arguments> ReadArguments(const Macro& macro, Stream& stream, Place place);
  [[nodiscard]] std::vector<TextToken> Substitute(const Macro& macro, const Arguments& arguments, Place place);
  [[nodiscard]] std::optional<TextToken> Special(const TextToken& word) const;

  Problems& problems_;
  std::map<std::string, Macro, std::less<>> macros_ = {};
  std::size_t steps_ = 0;
  int depth_ = 0;
};

/// The value of an expression behind #if, macros expanded and `defined` answered; nullopt if it is wrong, which has then
/// been told.
[[nodiscard]] std::optional<bool> ConditionValue(const std::vector<TextToken>& tokens, Place place,
                                                 Problems& problems);

}  // namespace runnel::genom
