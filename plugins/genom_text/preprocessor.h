#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/genom_text/macro.h"
#include "plugins/genom_text/text_lexer.h"

namespace runnel::genom {

/// Where included files are looked for, and what is defined from the start.
struct PreprocessorOptions {
  std::vector<std::string> include_folders = {};  ///< as of -I
  std::vector<std::string> definitions = {};      ///< as of -D: "NAME" or "NAME=VALUE"

  /// The compiler flags of a package ("pkg >= 1.0") that `#pragma requires` names; without it, such packages are
  /// taken to be there, and to need no flags.
  std::function<Result<std::vector<std::string>>(const std::string&)> flags_of_package = {};
};

/// The subset of the C preprocessor that descriptions use: includes, macros with and without parameters, conditions.
///
/// Bounded in everything: depth of includes, number of tokens, depth of conditions.
class Preprocessor {
 public:
  Preprocessor(const PreprocessorOptions& options, Problems& problems);

  /// The tokens of the file, and of all that it includes, behind those of the files before it. Pragmas are tokens.
  void Read(const std::string& file);
  void ReadText(const std::string& text, const std::string& name);

  [[nodiscard]] std::vector<TextToken> TakeTokens() { return std::move(tokens_); }
  [[nodiscard]] const std::string& notice() const { return notice_; }

 private:
  static constexpr std::size_t kDeepestInclude = 100;
  static constexpr std::size_t kMostTokens = 2'000'000;
  static constexpr std::size_t kMostFiles = 10'000;

  // A file, or a part of one between #if and #endif.
  struct Condition {
    Place place;
    bool was_true;   // one of its branches so far
    bool has_else = false;
  };
  struct OpenFile {
    std::string folder;
    std::unique_ptr<TextLexer> lexer;
    std::vector<Condition> conditions = {};
  };

  void ReadToEnd(std::string folder, const std::string& text, const std::string& name);
  void ReadLines();
  [[nodiscard]] TextLexer& lexer() { return *files_.back().lexer; }
  void Directive(Place place);
  void SkipBranch();
  [[nodiscard]] bool ConditionDirective(const std::string& word, Place place);
  void OtherDirective(const std::string& word, Place place);
  void Include(Place place);
  void Line(const std::vector<TextToken>& line_tokens, Place place);
  [[nodiscard]] bool TakesBranch(const std::string& word, Place place);
  void Pragma(Place place);
  void UsePackage(const std::string& package, Place place);
  void Open(bool is_true, Place place);
  [[nodiscard]] bool IsTrue(Place place);
  void Word(const TextToken& word);
  void Put(TextToken token);
  void GiveUp(Place place, std::string message, std::string hint = {});
  [[nodiscard]] std::vector<TextToken> LineTokens();

  PreprocessorOptions options_;
  Problems& problems_;
  MacroTable macros_;
  std::vector<OpenFile> files_;
  std::vector<TextToken> tokens_;
  std::size_t files_read_ = 0;
  std::string notice_;
  bool is_at_line_start_ = true;
  bool is_given_up_ = false;
};

}  // namespace runnel::genom
