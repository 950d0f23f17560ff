#include "core/base/argument_text.h"

#include <algorithm>
#include <utility>

#include "core/base/characters.h"
#include "core/base/result.h"

namespace runnel::internal {

namespace {

bool IsWhitespace(char character) { return character == ' ' || character == '\t' || character == '\r'; }
bool IsEndOfLine(char character) { return character == '\n'; }
bool IsControl(char character) {
  const auto code = static_cast<unsigned char>(character);
  return (code < 0x20 && !IsWhitespace(character) && !IsEndOfLine(character)) || code == 0x7f;
}
bool IsOpening(char character) { return character == '[' || character == '{'; }
bool IsClosing(char character) { return character == ']' || character == '}'; }

// Goes through the text and knows where it is.
class Reader {
 public:
  Reader(std::string_view text, const SourcePosition& begins) : text_(text), position_(begins) {
    if (position_.line == 0) position_ = {begins.file, 1, 1};
  }

  [[nodiscard]] bool IsAtEnd() const { return at_ == text_.size(); }
  [[nodiscard]] bool IsAtEndOfLine() const { return IsAtEnd() || IsEndOfLine(text_[at_]); }
  /// A semicolon ends one, too.
  [[nodiscard]] bool IsAtEndOfPart() const { return IsAtEndOfLine() || text_[at_] == ';'; }
  [[nodiscard]] bool IsAtEndOfArgument() const { return IsAtEndOfPart() || IsWhitespace(text_[at_]); }
  [[nodiscard]] char next() const { return text_[at_]; }
  [[nodiscard]] const SourcePosition& position() const { return position_; }

  char Take() {
    const char character = text_[at_++];
    // Characters, not bytes.
    if (IsEndOfLine(character)) {
      ++position_.line;
      position_.column = 1;
    } else if (at_ == text_.size() || (text_[at_] & 0xc0) != 0x80) {
      ++position_.column;
    }
    return character;
  }
  void SkipWhitespace() {
    while (!IsAtEnd() && IsWhitespace(next())) Take();
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
  constexpr std::string_view kNames = "\"\\ntr", kMeant = "\"\\\n\t\r";
  const SourcePosition position = reader.position();
  reader.Take();
  const std::size_t named = kNames.find(reader.IsAtEndOfLine() ? '\0' : reader.Take());
  if (named == std::string_view::npos) {
    return At(position, "a '\\' in quotation marks must stand before one of \" \\ n t r");
  }
  text += kMeant[named];
  return {};
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

// As the text format of types has it, strings and all: "{x: 1, name: \"a ]\"}".
Result<void> TakeBracketed(Reader& reader, std::string& text) {
  const SourcePosition begin = reader.position();
  std::size_t depth = 0;
  bool is_in_string = false;
  do {
    if (reader.IsAtEndOfLine()) return At(begin, "the bracket is not closed in its line");
    const char character = reader.Take();
    text += character;
    if (is_in_string && character == '\\' && !reader.IsAtEndOfLine()) {
      text += reader.Take();
    } else if (character == '"') {
      is_in_string = !is_in_string;
    } else if (!is_in_string) {
      if (IsOpening(character)) ++depth;
      if (IsClosing(character)) --depth;
    }
  } while (depth > 0);
  return {};
}

Result<void> TakePlain(Reader& reader, TextArgument& argument) {
  while (!reader.IsAtEndOfArgument()) {
    if (IsControl(reader.next())) return At(reader.position(), "a control character");
    if (reader.next() == '"') {
      return At(reader.position(), "a quotation mark in the middle of a word",
                "put the whole value into quotation marks, with \\\" for those inside");
    }
    const char character = reader.Take();
    argument.text += character;
    if (character != '=' || argument.equals) continue;
    argument.equals = argument.text.size() - 1;
    // A new value begins, which may be in marks of its own.
    if (!reader.IsAtEndOfArgument() && (reader.next() == '"' || IsOpening(reader.next()))) return {};
  }
  return {};
}

Result<TextArgument> TakeArgument(Reader& reader) {
  TextArgument argument{.position = reader.position()};
  if (reader.next() != '"' && !IsOpening(reader.next())) {
    if (auto taken = TakePlain(reader, argument); !taken) return taken.error();
  }
  if (reader.IsAtEndOfArgument()) return argument;
  auto taken = reader.next() == '"' ? TakeQuoted(reader, argument.text) : TakeBracketed(reader, argument.text);
  if (!taken) return taken.error();
  if (!reader.IsAtEndOfArgument()) {
    return At(reader.position(), "a blank is missing after the end of a value");
  }
  return argument;
}

Result<ArgumentLine> TakeLine(Reader& reader) {
  ArgumentLine line;
  for (reader.SkipWhitespace(); !reader.IsAtEndOfPart(); reader.SkipWhitespace()) {
    if (reader.next() == '#') {
      reader.SkipLine();
      break;
    }
    auto argument = TakeArgument(reader);
    if (!argument) return argument.error();
    line.push_back(std::move(*argument));
  }
  if (!reader.IsAtEnd()) reader.Take();
  return line;
}

}  // namespace

std::vector<ArgumentLine> SplitArguments(std::string_view text, const SourcePosition& begins,
                                         Diagnostics& diagnostics) {
  std::vector<ArgumentLine> lines;
  Reader reader(text, begins);
  while (!reader.IsAtEnd()) {
    auto line = TakeLine(reader);
    if (!line) {
      diagnostics.Add(line.error());
      reader.SkipLine();
    } else if (!line->empty()) {
      lines.push_back(std::move(*line));
    }
  }
  return lines;
}

std::string AsArgument(std::string_view text) {
  const auto needs_marks = [](char character) {
    return IsWhitespace(character) || IsEndOfLine(character) || IsControl(character) || character == '"' ||
           character == ';' || character == '\\' || character == '=';
  };
  const bool is_plain =
      !text.empty() && text.front() != '#' && !IsOpening(text.front()) && std::ranges::none_of(text, needs_marks);
  if (is_plain) return std::string(text);
  return Quoted(text);
}

}  // namespace runnel::internal
