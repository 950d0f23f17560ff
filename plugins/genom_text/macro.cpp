#include <algorithm>
#include <set>
#include <utility>

#include "plugins/genom_text/preprocessor.h"

namespace runnel::genom {

namespace {

using Kind = TextToken::Kind;
using Tokens = std::vector<TextToken>;

const std::string kVariadicName = "__VA_ARGS__";

std::string Stringified(const Tokens& tokens) {
  std::string text = "\"";
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (i > 0 && tokens[i].has_space_before) text += ' ';
    for (const char c : tokens[i].text) {
      if (c == '"' || (c == '\\' && tokens[i].kind == Kind::kString)) text += '\\';
      text += c;
    }
  }
  return text + '"';
}

// "a ## b": what the two make, cut anew.
Tokens Pasted(const TextToken& left, const TextToken& right, Problems& problems) {
  Tokens pasted = TextLexer(left.text + right.text, left.place.file, problems).LineTokens();
  for (TextToken& each : pasted) each.place = left.place;
  if (!pasted.empty()) pasted.front().has_space_before = left.has_space_before;
  return pasted;
}

}  // namespace

// Tokens that wait to be expanded, last first, then those of the file. Between them stand the ends of expansions:
// until its end has been read, a macro is not expanded again.
class MacroTable::Stream {
 public:
  explicit Stream(Source source) : source_(std::move(source)) {}

  TextToken Next() {
    while (!waiting_.empty()) {
      Entry entry = std::move(waiting_.back());
      waiting_.pop_back();
      if (entry.ends != nullptr) {
        open_.erase(open_.find(entry.ends->name));
        continue;
      }
      if (entry.token.kind == Kind::kWord && open_.contains(entry.token.text)) entry.token.is_fixed = true;
      return std::move(entry.token);
    }
    return source_();
  }
  void Put(TextToken token) { waiting_.push_back({std::move(token), nullptr}); }
  void PutExpansion(const Macro& macro, Tokens tokens) {
    open_.insert(macro.name);
    waiting_.push_back({{}, &macro});
    for (auto each = tokens.rbegin(); each != tokens.rend(); ++each) Put(std::move(*each));
  }
  [[nodiscard]] bool is_expanding() const { return !waiting_.empty(); }

 private:
  struct Entry {
    TextToken token;
    const Macro* ends;
  };

  Source source_;
  std::vector<Entry> waiting_ = {};
  std::multiset<std::string_view> open_ = {};
};

bool MacroTable::Has(const std::string& name) const {
  return macros_.contains(name) || name == "__FILE__" || name == "__LINE__";
}

void MacroTable::DefineByText(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string line =
      equals == std::string::npos ? text + " 1" : text.substr(0, equals) + " " + text.substr(equals + 1);
  Define(TextLexer(line, -1, problems_).LineTokens(), {});  // in no file
}

void MacroTable::Define(const Tokens& line, Place place) {
  if (line.empty() || line[0].kind != Kind::kWord) {
    problems_.Add(place, "#define needs the name of a macro");
    return;
  }
  Macro macro{.name = line[0].text, .place = line[0].place};
  if (macro.name == "defined") {
    problems_.Add(macro.place, "a macro cannot be called 'defined'");
    return;
  }
  std::size_t at = 1;
  if (at < line.size() && line[at].IsMark("(") && !line[at].has_space_before) {
    macro.has_parameters = true;
    ++at;
    while (at < line.size() && !line[at].IsMark(")")) {
      if (line[at].IsMark("...")) {
        macro.is_variadic = true;
        macro.parameters.push_back(kVariadicName);
      } else if (line[at].kind == Kind::kWord && !macro.is_variadic &&
                 std::ranges::find(macro.parameters, line[at].text) == macro.parameters.end()) {
        macro.parameters.push_back(line[at].text);
      } else {
        problems_.Add(line[at].place, "the parameters of macro '" + macro.name + "' are names, each once");
        return;
      }
      if (++at < line.size() && line[at].IsMark("...") && !macro.is_variadic) {  // "args..."
        macro.is_variadic = true;
        ++at;
      }
      if (at < line.size() && line[at].IsMark(",")) ++at;
    }
    if (at >= line.size()) {
      problems_.Add(place, "the parameters of macro '" + macro.name + "' do not end", "close them by )");
      return;
    }
    ++at;
  }
  macro.body.assign(line.begin() + static_cast<std::ptrdiff_t>(at), line.end());
  if (!macro.body.empty() && (macro.body.front().IsMark("##") || macro.body.back().IsMark("##"))) {
    problems_.Add(place, "a macro can neither begin nor end with ##");
    return;
  }
  macros_.insert_or_assign(macro.name, std::move(macro));
}

std::optional<TextToken> MacroTable::Special(const TextToken& word) const {
  TextToken token{.place = word.place, .has_space_before = word.has_space_before};
  if (word.text == "__LINE__") {
    token.kind = Kind::kNumber;
    token.text = std::to_string(word.place.line);
    return token;
  }
  if (word.text == "__FILE__" && word.place.file >= 0) {
    token.kind = Kind::kString;
    token.text = '"' + problems_.FileName(word.place.file) + '"';
    return token;
  }
  return std::nullopt;
}

// False: there is no more of it.
bool MacroTable::Spend(const TextToken& token) {
  steps_ += SizeOf(token);
  if (steps_ > kMostSteps && !std::exchange(is_spent_, true)) {
    problems_.Add(token.place, "macros grow to too many tokens here");
  }
  return !is_spent_;
}

std::optional<MacroTable::Arguments> MacroTable::ReadArguments(const Macro& macro, Stream& stream, Place place) {
  Arguments arguments(1);
  int depth = 0;
  for (TextToken next = stream.Next();; next = stream.Next()) {
    if (!Spend(next)) return std::nullopt;
    if (next.kind == Kind::kEnd) {
      problems_.Add(place, "the arguments of macro '" + macro.name + "' do not end", "close them by )");
      return std::nullopt;
    }
    if (next.kind == Kind::kNewline) continue;
    if (depth == 0 && next.IsMark(")")) break;
    if (next.IsMark("(")) ++depth;
    if (next.IsMark(")")) --depth;
    const bool takes_rest = macro.is_variadic && arguments.size() == macro.parameters.size();
    if (depth == 0 && next.IsMark(",") && !takes_rest) {
      arguments.emplace_back();
    } else {
      arguments.back().push_back(std::move(next));
    }
  }
  if (macro.parameters.empty() && arguments.size() == 1 && arguments[0].empty()) arguments.clear();
  if (macro.is_variadic && arguments.size() + 1 == macro.parameters.size()) arguments.emplace_back();
  if (arguments.size() != macro.parameters.size()) {
    problems_.Add(place,
                  "macro '" + macro.name + "' takes " + std::to_string(macro.parameters.size()) + " arguments, not " +
                      std::to_string(arguments.size()),
                  problems_.DeclaredAt(macro.place));
    return std::nullopt;
  }
  return arguments;
}

std::vector<TextToken> MacroTable::Substitute(const Macro& macro, const Arguments& arguments, Place place) {
  const auto argument_of = [&](const TextToken& token) -> const Tokens* {
    if (token.kind != Kind::kWord) return nullptr;
    const auto found = std::ranges::find(macro.parameters, token.text);
    if (found == macro.parameters.end()) return nullptr;
    return &arguments[static_cast<std::size_t>(found - macro.parameters.begin())];
  };
  Tokens result;
  const auto append = [&](const Tokens& tokens) {
    for (const TextToken& each : tokens) {
      if (Spend(each)) result.push_back(each);
    }
  };
  std::size_t left = 0;  // where the left operand of a ## begins; an empty argument has nothing there
  for (std::size_t i = 0; i < macro.body.size(); ++i) {
    const TextToken& token = macro.body[i];
    if (!Spend(token)) break;
    if (!token.IsMark("##")) left = result.size();
    const bool is_pasted = i + 1 < macro.body.size() && macro.body[i + 1].IsMark("##");
    if (token.IsMark("##") && i + 1 < macro.body.size()) {
      const TextToken& right = macro.body[++i];
      const Tokens* argument = argument_of(right);
      Tokens rest = argument != nullptr ? *argument : Tokens{right};
      if (result.size() > left && !rest.empty()) {
        const Tokens pasted = Pasted(result.back(), rest.front(), problems_);
        result.pop_back();
        append(pasted);
        rest.erase(rest.begin());
      }
      append(rest);
    } else if (macro.has_parameters && token.IsMark("#") && i + 1 < macro.body.size() &&
               argument_of(macro.body[i + 1]) != nullptr) {
      append({{.kind = Kind::kString,
               .text = Stringified(*argument_of(macro.body[++i])),
               .place = place,
               .has_space_before = true}});
    } else if (const Tokens* argument = argument_of(token); argument != nullptr) {
      append(is_pasted ? *argument : ExpandAll(*argument));
    } else {
      result.push_back(token);
    }
  }
  for (TextToken& each : result) each.place = place;
  return result;
}

std::vector<TextToken> MacroTable::ExpandStream(Stream& stream) {
  Tokens result;
  if (++depth_ > kDeepest) {
    problems_.Add(stream.Next().place, "macros are nested too deeply here");
    is_spent_ = true;
    --depth_;
    return result;
  }
  for (TextToken next = stream.Next(); next.kind != Kind::kEnd; next = stream.Next()) {
    if (!Spend(next)) break;
    const auto found = next.kind == Kind::kWord && !next.is_fixed ? macros_.find(next.text) : macros_.end();
    if (found == macros_.end()) {
      const auto special = next.kind == Kind::kWord ? Special(next) : std::nullopt;
      result.push_back(special ? *special : std::move(next));
      if (!stream.is_expanding()) break;
      continue;
    }
    const Macro& macro = found->second;
    if (!macro.has_parameters) {
      stream.PutExpansion(macro, Substitute(macro, {}, next.place));
      if (!stream.is_expanding()) break;
      continue;
    }
    Tokens passed;
    TextToken open = stream.Next();
    while (open.kind == Kind::kNewline) {
      passed.push_back(std::move(open));
      open = stream.Next();
    }
    if (!open.IsMark("(")) {
      result.push_back(std::move(next));
      stream.Put(std::move(open));
      continue;
    }
    const auto arguments = ReadArguments(macro, stream, next.place);
    if (!arguments) break;
    stream.PutExpansion(macro, Substitute(macro, *arguments, next.place));
    if (!stream.is_expanding()) break;
  }
  --depth_;
  return result;
}

std::vector<TextToken> MacroTable::ExpandAll(const Tokens& tokens) {
  std::size_t at = 0;
  Tokens result;
  while (at < tokens.size()) {
    Stream stream([&]() -> TextToken { return at < tokens.size() ? tokens[at++] : TextToken{}; });
    const Tokens some = ExpandStream(stream);
    result.insert(result.end(), some.begin(), some.end());
    if (is_spent_ || depth_ >= kDeepest) break;
  }
  return result;
}

std::vector<TextToken> MacroTable::Expand(const TextToken& word, const Source& source) {
  Stream stream(source);
  stream.Put(word);
  return ExpandStream(stream);
}

}  // namespace runnel::genom
