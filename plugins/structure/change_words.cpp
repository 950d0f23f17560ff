#include "plugins/structure/change_words.h"

#include <algorithm>

namespace runnel::internal {

namespace {

bool IsBlank(char letter) { return letter == ' ' || letter == '\t' || letter == '\r'; }
bool IsEndOfLine(char letter) { return letter == '\n'; }
bool IsControl(char letter) {
  const auto code = static_cast<unsigned char>(letter);
  return (code < 0x20 && !IsBlank(letter) && !IsEndOfLine(letter)) || code == 0x7f;
}
bool IsOpening(char letter) { return letter == '[' || letter == '{'; }
bool IsClosing(char letter) { return letter == ']' || letter == '}'; }

// Goes through the text and knows where it is.
class Reader {
 public:
  Reader(std::string_view text, const SourcePosition& begins) : text_(text), position_(begins) {
    if (position_.line == 0) position_ = {begins.file, 1, 1};
  }

  [[nodiscard]] bool IsAtEnd() const { return at_ == text_.size(); }
  [[nodiscard]] bool IsAtEndOfLine() const { return IsAtEnd() || IsEndOfLine(text_[at_]); }
  /// Of a change.
  [[nodiscard]] bool IsAtEndOfChange() const { return IsAtEndOfLine() || text_[at_] == ';'; }
  [[nodiscard]] bool IsAtEndOfWord() const { return IsAtEndOfChange() || IsBlank(text_[at_]); }
  [[nodiscard]] char next() const { return text_[at_]; }
  [[nodiscard]] const SourcePosition& position() const { return position_; }

  char Take() {
    const char letter = text_[at_++];
    // Characters, not bytes.
    if (IsEndOfLine(letter)) {
      ++position_.line;
      position_.column = 1;
    } else if (at_ == text_.size() || (text_[at_] & 0xc0) != 0x80) {
      ++position_.column;
    }
    return letter;
  }
  void SkipBlanks() {
    while (!IsAtEnd() && IsBlank(next())) Take();
  }
  void SkipLine() {
    while (!IsAtEndOfLine()) Take();
  }

 private:
  const std::string_view text_;
  std::size_t at_ = 0;
  SourcePosition position_;
};

Error At(const SourcePosition& position, std::string message, std::string hint = {}) {
  return {.message = std::move(message), .position = position, .hint = std::move(hint)};
}

Result<void> TakeEscaped(Reader& reader, std::string& text) {
  const SourcePosition position = reader.position();
  reader.Take();
  const char letter = reader.IsAtEndOfLine() ? '\0' : reader.Take();
  switch (letter) {
    case '"':
    case '\\':
      text += letter;
      return {};
    case 'n':
      text += '\n';
      return {};
    case 't':
      text += '\t';
      return {};
    case 'r':
      text += '\r';
      return {};
    default:
      return At(position, "a '\\' in quotation marks must stand before one of \" \\ n t r");
  }
}

Result<void> TakeQuoted(Reader& reader, std::string& text) {
  const SourcePosition begin = reader.position();
  reader.Take();
  while (!reader.IsAtEndOfLine() && reader.next() != '"') {
    if (reader.next() == '\\') {
      if (auto taken = TakeEscaped(reader, text); !taken) return taken;
    } else {
      text += reader.Take();
    }
  }
  if (reader.IsAtEndOfLine()) {
    return At(begin, "the quotation mark is not closed in its line");
  }
  reader.Take();
  return {};
}

// As the text form of types has it, strings and all: "{x: 1, name: \"a ]\"}".
Result<void> TakeBracketed(Reader& reader, std::string& text) {
  const SourcePosition begin = reader.position();
  std::size_t depth = 0;
  bool is_in_string = false;
  do {
    if (reader.IsAtEndOfLine()) return At(begin, "the bracket is not closed in its line");
    const char letter = reader.Take();
    text += letter;
    if (is_in_string && letter == '\\' && !reader.IsAtEndOfLine()) {
      text += reader.Take();
    } else if (letter == '"') {
      is_in_string = !is_in_string;
    } else if (!is_in_string) {
      if (IsOpening(letter)) ++depth;
      if (IsClosing(letter)) --depth;
    }
  } while (depth > 0);
  return {};
}

Result<void> TakePlain(Reader& reader, ChangeWord& word) {
  while (!reader.IsAtEndOfWord()) {
    if (IsControl(reader.next())) return At(reader.position(), "a control character");
    if (reader.next() == '"') {
      return At(reader.position(), "a quotation mark in the middle of a word",
                "put the whole value into quotation marks, with \\\" for those inside");
    }
    const char letter = reader.Take();
    word.text += letter;
    if (letter != '=' || word.equals) continue;
    word.equals = word.text.size() - 1;
    // A new value begins, which may be in marks of its own.
    if (!reader.IsAtEndOfWord() && (reader.next() == '"' || IsOpening(reader.next()))) return {};
  }
  return {};
}

Result<ChangeWord> TakeWord(Reader& reader) {
  ChangeWord word{.position = reader.position()};
  if (reader.next() != '"' && !IsOpening(reader.next())) {
    if (auto taken = TakePlain(reader, word); !taken) return taken.error();
  }
  if (reader.IsAtEndOfWord()) return word;
  auto taken =
      reader.next() == '"' ? TakeQuoted(reader, word.text) : TakeBracketed(reader, word.text);
  if (!taken) return taken.error();
  if (!reader.IsAtEndOfWord()) {
    return At(reader.position(), "a blank is missing after the end of a value");
  }
  return word;
}

Result<ChangeLine> TakeChange(Reader& reader) {
  ChangeLine line;
  for (reader.SkipBlanks(); !reader.IsAtEndOfChange(); reader.SkipBlanks()) {
    if (reader.next() == '#') {
      reader.SkipLine();
      break;
    }
    auto word = TakeWord(reader);
    if (!word) return word.error();
    line.push_back(std::move(*word));
  }
  if (!reader.IsAtEnd()) reader.Take();
  return line;
}

}  // namespace

std::vector<ChangeLine> SplitChanges(std::string_view text, const SourcePosition& begins,
                                     Diagnostics& diagnostics) {
  std::vector<ChangeLine> lines;
  Reader reader(text, begins);
  while (!reader.IsAtEnd()) {
    auto line = TakeChange(reader);
    if (!line) {
      diagnostics.Add(line.error());
      reader.SkipLine();
    } else if (!line->empty()) {
      lines.push_back(std::move(*line));
    }
  }
  return lines;
}

std::string AsWord(std::string_view text) {
  const auto needs_marks = [](char letter) {
    return IsBlank(letter) || IsEndOfLine(letter) || IsControl(letter) || letter == '"' ||
           letter == ';' || letter == '\\' || letter == '=';
  };
  const bool is_plain = !text.empty() && text.front() != '#' && !IsOpening(text.front()) &&
                        std::ranges::none_of(text, needs_marks);
  if (is_plain) return std::string(text);
  std::string word = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') word += '\\';
    if (letter == '\n') {
      word += "\\n";
    } else if (letter == '\r') {
      word += "\\r";
    } else if (letter == '\t') {
      word += "\\t";
    } else {
      word += letter;
    }
  }
  return word + '"';
}

}  // namespace runnel::internal
