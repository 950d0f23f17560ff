#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/genom_text/place.h"

namespace runnel::genom {

/// What a token takes: the longer its text, the more.
[[nodiscard]] inline std::size_t SizeOf(const TextToken& token) { return 1 + token.text.size() / 16; }

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

  /// The macros of the whole description have grown too much, which has been told.
  [[nodiscard]] bool is_spent() const noexcept { return is_spent_; }

 private:
  static constexpr std::size_t kMostSteps = 2'000'000;
  static constexpr int kDeepest = 64;
  using Arguments = std::vector<std::vector<TextToken>>;
  class Stream;

  [[nodiscard]] std::vector<TextToken> ExpandStream(Stream& stream);
  [[nodiscard]] std::optional<Arguments> ReadArguments(const Macro& macro, Stream& stream, Place place);
  [[nodiscard]] std::vector<TextToken> Substitute(const Macro& macro, const Arguments& arguments, Place place);
  [[nodiscard]] std::optional<TextToken> Special(const TextToken& word) const;
  [[nodiscard]] bool Spend(const TextToken& token);

  Problems& problems_;
  std::map<std::string, Macro, std::less<>> macros_ = {};
  std::size_t steps_ = 0;  // never less: many small macros take as long as one that is large
  bool is_spent_ = false;
  int depth_ = 0;
};

/// The value of an expression behind #if, macros expanded and `defined` answered; nullopt if it is wrong, which has then
/// been told.
[[nodiscard]] std::optional<bool> ConditionValue(const std::vector<TextToken>& tokens, Place place, Problems& problems);

/// Cuts the text of one file into tokens. Lines that end with a backslash go on in the next one; comments are
/// blanks; strings may span lines but in directives.
class TextLexer {
 public:
  TextLexer(const std::string& text, int file, Problems& problems);

  /// The next token; kNewline between lines, kEnd at the end and from then on.
  [[nodiscard]] TextToken Next(bool is_directive = false);

  /// The tokens of the rest of a directive's line, and moves behind it.
  [[nodiscard]] std::vector<TextToken> LineTokens();
  /// The rest of the line as text without comments, and moves behind it.
  [[nodiscard]] std::string RestOfLine();

  /// Moves to the next line whose first character but blanks is '#', without looking at what is between. False at the end.
  [[nodiscard]] bool SkipToDirective();

  /// What follows is said to be line `line` of `file`, as #line wants it.
  void Renumber(int line, int file);
  [[nodiscard]] Place here() const;

  /// Text of the first comment that begins with "/*/", "" if there was none.
  [[nodiscard]] const std::string& notice() const { return notice_; }

 private:
  [[nodiscard]] char At(std::size_t ahead = 0) const {
    return position_ + ahead < text_.size() ? text_[position_ + ahead] : '\0';
  }
  [[nodiscard]] bool IsAtEnd() const { return position_ >= text_.size(); }
  bool SkipBlanks();
  void SkipBlockComment();
  [[nodiscard]] TextToken Take(TextToken::Kind kind, std::size_t length, Place place);
  [[nodiscard]] TextToken Quoted(char quote, bool is_directive, Place place);
  [[nodiscard]] std::size_t WordLength() const;
  [[nodiscard]] std::size_t NumberLength() const;

  struct LineStart {
    std::size_t offset;
    int line;
    int column;
  };

  std::string text_;  // without continuations
  std::vector<LineStart> lines_;
  int file_;
  int line_change_ = 0;
  Problems& problems_;
  std::size_t position_ = 0;
  std::string notice_;
};

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
  /// What was read is not all: a file is missing, or #error was met, which has been told.
  [[nodiscard]] bool is_given_up() const noexcept { return is_given_up_; }

 private:
  static constexpr std::size_t kDeepestInclude = 100;
  static constexpr std::size_t kMostTokens = 2'000'000;
  static constexpr std::size_t kMostFiles = 10'000;

  // A file, or a part of one between #if and #endif.
  struct Condition {
    Place place;
    bool was_true;  // one of its branches so far
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

  PreprocessorOptions options_;
  Problems& problems_;
  MacroTable macros_;
  std::vector<OpenFile> files_;
  std::vector<TextToken> tokens_;
  std::size_t size_ = 0;
  std::size_t files_read_ = 0;
  std::string notice_;
  bool is_at_line_start_ = true;
  bool is_given_up_ = false;
};

/// The words of a pragma, separated by blanks; what stands in quotation marks is one word, without them.
[[nodiscard]] inline std::vector<std::string> QuotedWords(std::string_view text) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const bool is_quoted = text[at] == '"';
    if (is_quoted) ++at;
    std::size_t end = text.find_first_of(is_quoted ? "\"" : " \t", at);
    if (end == std::string_view::npos) end = text.size();
    words.emplace_back(text.substr(at, end - at));
    at = end + (is_quoted && end < text.size() ? 1 : 0);
  }
  return words;
}

}  // namespace runnel::genom
