#pragma once

#include <string>
#include <vector>

#include "plugins/genom_text/place.h"

namespace runnel::genom {

/// Cuts the text of one file into tokens. Lines that end with a backslash go on in the next one; comments are
/// blanks; strings may span lines but in directives.
class TextLexer {
 public:
  TextLexer(const std::string& text, int file, Problems& problems);

  /// The next token; kNewline between lines, kEnd at the end and from then on.
  [[nodiscard]] TextToken Next(bool is_directive = false);

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

}  // namespace runnel::genom
