#include "plugins/genom_text/preprocessor.h"

#include <charconv>
#include <filesystem>

#include "core/base/files.h"

namespace runnel::genom {

namespace {

using Kind = TextToken::Kind;

std::string FolderOf(const std::string& file) { return std::filesystem::path(file).parent_path().string(); }

}  // namespace

Preprocessor::Preprocessor(const PreprocessorOptions& options, Problems& problems)
    : options_(options), problems_(problems), macros_(problems) {
  macros_.DefineByText("__GENOM__=2.99.41");
  for (const std::string& each : options_.definitions) macros_.DefineByText(each);
}

void Preprocessor::Read(const std::string& file) {
  const auto text = TextOfFile(file);
  if (!text) {
    GiveUp({problems_.FileIndex(file), 0, 0}, "this file cannot be read");
    return;
  }
  ReadToEnd(FolderOf(file), *text, file);
}

void Preprocessor::ReadText(const std::string& text, const std::string& name) { ReadToEnd(FolderOf(name), text, name); }

void Preprocessor::GiveUp(Place place, std::string message, std::string hint) {
  if (!is_given_up_) problems_.Add(place, std::move(message), std::move(hint));
  is_given_up_ = true;
}

void Preprocessor::ReadToEnd(std::string folder, const std::string& text, const std::string& name) {
  files_.push_back(
      {.folder = std::move(folder), .lexer = std::make_unique<TextLexer>(text, problems_.FileIndex(name), problems_)});
  is_at_line_start_ = true;
  ReadLines();
  for (const Condition& each : files_.back().conditions) {
    if (!is_given_up_) problems_.Add(each.place, "this condition has no end", "close it by #endif");
  }
  if (notice_.empty()) notice_ = lexer().notice();
  files_.pop_back();
  is_at_line_start_ = true;
}

void Preprocessor::Put(TextToken token) {
  if (token.kind == Kind::kNewline || token.kind == Kind::kEnd) return;
  if ((size_ += SizeOf(token)) > kMostTokens) {
    GiveUp(token.place, "this description has too many tokens");
    return;
  }
  tokens_.push_back(std::move(token));
}

void Preprocessor::ReadLines() {
  while (!(is_given_up_ |= macros_.is_spent())) {
    TextToken token = lexer().Next();
    if (token.kind == Kind::kEnd) return;
    if (is_at_line_start_ && token.IsMark("#")) {
      Directive(token.place);
      is_at_line_start_ = true;
      continue;
    }
    is_at_line_start_ = token.kind == Kind::kNewline;
    if (token.kind == Kind::kWord) {
      Word(token);
    } else {
      Put(std::move(token));
    }
  }
}

void Preprocessor::Word(const TextToken& word) {
  if (!macros_.Has(word.text)) {
    Put(word);
    return;
  }
  const auto source = [this]() -> TextToken {
    TextToken next = lexer().Next();
    while (is_at_line_start_ && next.IsMark("#")) {
      problems_.Add(next.place, "a directive cannot stand between a macro and the end of its arguments");
      (void)lexer().RestOfLine();
      (void)lexer().Next();
      next = lexer().Next();
    }
    is_at_line_start_ = next.kind == Kind::kNewline;
    return next;
  };
  for (TextToken& each : macros_.Expand(word, source)) Put(std::move(each));
}

void Preprocessor::Directive(Place place) {
  const TextToken word = lexer().Next(true);
  if (word.kind == Kind::kNewline || word.kind == Kind::kEnd) return;  // "#" alone
  if (word.kind == Kind::kNumber) {                                    // "# 12 "file"", as other preprocessors write
    std::vector<TextToken> line = lexer().LineTokens();
    line.insert(line.begin(), word);
    Line(line, place);
    return;
  }
  if (!ConditionDirective(word.text, place)) OtherDirective(word.text, place);
}

void Preprocessor::Open(bool is_true, Place place) {
  files_.back().conditions.push_back({place, is_true});
  if (!is_true) SkipBranch();
}

bool Preprocessor::IsTrue(Place place) {
  std::vector<TextToken> tokens;
  std::vector<TextToken> line = lexer().LineTokens();
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!line[i].Is(Kind::kWord, "defined")) {
      tokens.push_back(line[i]);
      continue;
    }
    const bool has_parenthesis = i + 1 < line.size() && line[i + 1].IsMark("(");
    const std::size_t at = i + (has_parenthesis ? 2 : 1);
    if (at >= line.size() || line[at].kind != Kind::kWord ||
        (has_parenthesis && (at + 1 >= line.size() || !line[at + 1].IsMark(")")))) {
      problems_.Add(line[i].place, "'defined' needs the name of a macro", "write defined(NAME)");
      return false;
    }
    tokens.push_back({.kind = Kind::kNumber, .text = macros_.Has(line[at].text) ? "1" : "0", .place = line[i].place});
    i = at + (has_parenthesis ? 1 : 0);
  }
  return ConditionValue(macros_.ExpandAll(tokens), place, problems_).value_or(false);
}

// Whether the branch behind #elif or #else is read, where none before it was.
bool Preprocessor::TakesBranch(const std::string& word, Place place) {
  Condition& condition = files_.back().conditions.back();
  if (condition.has_else) problems_.Add(place, "#" + word + " behind #else");
  if (word == "else") condition.has_else = true;
  bool is_taken = !condition.was_true;
  if (word == "elif" && is_taken) {
    is_taken = IsTrue(place);
  } else {
    (void)lexer().LineTokens();
  }
  if (is_taken) condition.was_true = true;
  return is_taken;
}

// The lexer stands behind the directive whose branch is not to be read; afterwards behind the one that ends that.
void Preprocessor::SkipBranch() {
  std::size_t depth = 0;
  while (lexer().SkipToDirective()) {
    const Place place = lexer().here();
    const TextToken word = lexer().Next(true);
    if (word.kind == Kind::kNewline) continue;
    const bool is_opening = word.text == "if" || word.text == "ifdef" || word.text == "ifndef";
    if (depth == 0 && (word.text == "elif" || word.text == "else")) {
      if (TakesBranch(word.text, place)) return;
      continue;
    }
    (void)lexer().RestOfLine();
    (void)lexer().Next(true);
    if (is_opening) ++depth;
    if (word.text != "endif") continue;
    if (depth == 0) {
      files_.back().conditions.pop_back();
      return;
    }
    --depth;
  }
}

bool Preprocessor::ConditionDirective(const std::string& word, Place place) {
  std::vector<Condition>& conditions = files_.back().conditions;
  if (word == "if") {
    Open(IsTrue(place), place);
    return true;
  }
  if (word == "ifdef" || word == "ifndef") {
    const auto tokens = lexer().LineTokens();
    if (tokens.size() != 1 || tokens[0].kind != Kind::kWord) {
      problems_.Add(place, "#" + word + " needs the name of a macro, and nothing else");
    }
    const bool has = !tokens.empty() && macros_.Has(tokens[0].text);
    Open(has == (word == "ifdef"), place);
    return true;
  }
  if (word != "elif" && word != "else" && word != "endif") return false;
  if (conditions.empty()) {
    problems_.Add(place, "#" + word + " without #if");
    (void)lexer().LineTokens();
    return true;
  }
  if (word == "endif") {
    (void)lexer().LineTokens();
    conditions.pop_back();
  } else if (!TakesBranch(word, place)) {
    SkipBranch();
  }
  return true;
}

void Preprocessor::OtherDirective(const std::string& word, Place place) {
  if (word == "define") {
    macros_.Define(lexer().LineTokens(), place);
  } else if (word == "undef") {
    const auto tokens = lexer().LineTokens();
    if (tokens.size() == 1 && tokens[0].kind == Kind::kWord) {
      macros_.Undefine(tokens[0].text);
    } else {
      problems_.Add(place, "#undef needs the name of a macro, and nothing else");
    }
  } else if (word == "include") {
    Include(place);
  } else if (word == "pragma") {
    Pragma(place);
  } else if (word == "line") {
    Line(lexer().LineTokens(), place);
  } else if (word == "error") {
    GiveUp(place, "#error " + lexer().RestOfLine());
  } else if (word == "warning") {
    problems_.Warn(place, "#warning " + lexer().RestOfLine());
  } else {
    problems_.Warn(place, "nobody knows #" + word + ", it changes nothing");
    (void)lexer().LineTokens();
  }
}

void Preprocessor::Line(const std::vector<TextToken>& line_tokens, Place place) {
  const std::vector<TextToken> tokens = macros_.ExpandAll(line_tokens);
  int line = 0;
  const std::string text = tokens.empty() || tokens[0].kind != Kind::kNumber ? "" : tokens[0].text;
  if (std::from_chars(text.data(), text.data() + text.size(), line).ec != std::errc() || line < 0) {
    problems_.Add(place, "#line needs the number of a line");
    return;
  }
  int file = place.file;
  if (tokens.size() > 1 && tokens[1].kind == Kind::kString && tokens[1].text.size() > 2) {
    file = problems_.FileIndex(tokens[1].text.substr(1, tokens[1].text.size() - 2));
  }
  lexer().Renumber(line, file);
}

void Preprocessor::Include(Place place) {
  std::string rest = lexer().RestOfLine();
  if (!rest.starts_with('"') && !rest.starts_with('<')) {  // a macro
    const std::vector<TextToken> tokens = TextLexer(rest, place.file, problems_).LineTokens();
    rest.clear();
    for (const TextToken& each : macros_.ExpandAll(tokens)) rest += each.text;
  }
  const bool is_quoted = rest.starts_with('"');
  const std::size_t end = rest.size() > 1 ? rest.find(is_quoted ? '"' : '>', 1) : std::string::npos;
  if (end == std::string::npos || (!is_quoted && !rest.starts_with('<'))) {
    GiveUp(place, "#include needs the name of a file", "write #include \"FILE\" or #include <FILE>");
    return;
  }
  const std::filesystem::path name = rest.substr(1, end - 1);
  std::vector<std::string> folders;
  if (is_quoted) folders.push_back(files_.back().folder);
  folders.insert(folders.end(), options_.include_folders.begin(), options_.include_folders.end());
  if (files_.size() >= kDeepestInclude || ++files_read_ > kMostFiles) {
    GiveUp(place, "files include each other without end", "put #ifndef, #define and #endif around what each holds");
    return;
  }
  for (const std::string& folder : folders) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (const auto text = TextOfFile(file)) {
      ReadToEnd(file.parent_path().string(), *text, file.string());
      return;
    }
  }
  std::string looked;
  for (const std::string& each : folders) looked += (looked.empty() ? "" : ", ") + (each.empty() ? "." : each);
  GiveUp(place, "there is no file '" + name.string() + "' to include",
         "it was looked for in " + (looked.empty() ? "no folder; give one by -I" : looked));
}

void Preprocessor::Pragma(Place place) {
  const std::string text = lexer().RestOfLine();
  const std::vector<std::string> words = QuotedWords(text);
  if (words.empty()) {
    problems_.Add(place, "#pragma needs to say what");
    return;
  }
  if (words[0] == "require" || words[0] == "requires") {
    for (std::size_t i = 1; i < words.size(); ++i) UsePackage(words[i], place);
  }
  Put({.kind = Kind::kPragma, .text = text, .place = place});
}

void Preprocessor::UsePackage(const std::string& package, Place place) {
  if (!options_.flags_of_package) return;
  const auto flags = options_.flags_of_package(package);
  if (!flags) {
    GiveUp(place, flags.error().message, flags.error().hint);
    return;
  }
  for (const std::string& flag : *flags) {
    if (flag.starts_with("-I")) options_.include_folders.push_back(flag.substr(2));
    if (flag.starts_with("-D")) macros_.DefineByText(flag.substr(2));
  }
}

}  // namespace runnel::genom
