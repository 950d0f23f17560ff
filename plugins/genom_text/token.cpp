#include "plugins/genom_text/token.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace runnel::genom {

namespace {

using Kind = Token::Kind;

constexpr std::array<std::string_view, 32> kReserved = {
    "module",  "FALSE",   "TRUE",     "unsigned", "short",   "long", "fixed",  "float", "double", "char",   "wchar",
    "string",  "wstring", "boolean",  "octet",    "object",  "any",  "const",  "enum",  "union",  "switch", "case",
    "default", "struct",  "sequence", "optional", "typedef", "xor",  "bitand", "bitor", "compl",  "not"};

struct OtherSpelling {
  std::string_view from;
  std::string_view to;
};
constexpr std::array<OtherSpelling, 9> kOtherSpellings = {{{"<%", "{"},
                                                           {"%>", "}"},
                                                           {"<:", "["},
                                                           {":>", "]"},
                                                           {"xor", "^"},
                                                           {"bitand", "&"},
                                                           {"bitor", "|"},
                                                           {"compl", "~"},
                                                           {"not", "!"}}};

bool IsNumeral(char c) { return c >= '0' && c <= '9'; }
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool IsHexadecimal(char c) { return IsNumeral(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

// Numbers and what sticks to them: "64k" is 64 and k.
class NumberCutter {
 public:
  NumberCutter(const TextToken& text, std::vector<Token>& into, Problems& problems)
      : text_(text.text), place_(text.place), into_(into), problems_(problems) {}

  void Cut() {
    while (at_ < text_.size()) {
      const Place place{place_.file, place_.line, place_.column + static_cast<int>(at_)};
      if (IsNumeral(At(0)) || (At(0) == '.' && IsNumeral(At(1)))) {
        CutNumber(place);
      } else if (IsLetter(At(0))) {
        const std::size_t begin = at_;
        while (IsLetter(At(0)) || IsNumeral(At(0))) ++at_;
        into_.push_back({.kind = Kind::kWord, .text = text_.substr(begin, at_ - begin), .place = place});
      } else {
        into_.push_back({.kind = Kind::kMark, .text = text_.substr(at_++, 1), .place = place});
      }
    }
  }

 private:
  [[nodiscard]] char At(std::size_t ahead) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void CutNumber(Place place) {
    if (At(0) == '0' && (At(1) == 'x' || At(1) == 'X') && IsHexadecimal(At(2))) {
      std::size_t length = 2;
      while (IsHexadecimal(At(length))) ++length;
      PutInteger(length, 16, 2, place);
      return;
    }
    const char* const begin = text_.data() + at_;
    double real = 0;
    const char* const end = std::from_chars(begin, text_.data() + text_.size(), real).ptr;
    const auto length = static_cast<std::size_t>(end - begin);
    if (std::string_view(begin, length).find_first_of(".eE") == std::string_view::npos) {
      PutInteger(length, text_[at_] == '0' && length > 1 ? 8 : 10, 0, place);
      return;
    }
    Token token{.kind = Kind::kReal, .text = text_.substr(at_, length), .place = place};
    token.real = std::strtod(token.text.c_str(), nullptr);
    if (!std::isfinite(token.real)) problems_.Add(place, "'" + token.text + "' is too large for a double");
    at_ += length;
    const char suffix = At(0);
    const bool is_end = !IsLetter(At(1)) && !IsNumeral(At(1));
    if (is_end && (suffix == 'd' || suffix == 'D')) token.kind = Kind::kFixed;
    if (is_end && std::string_view("fFlLdD").find(suffix) != std::string_view::npos && suffix != '\0') ++at_;
    into_.push_back(std::move(token));
  }

  void PutInteger(std::size_t length, int base, std::size_t skip, Place place) {
    Token token{.kind = Kind::kInteger, .text = text_.substr(at_, length), .place = place};
    const char* const past = token.text.data() + length;
    const auto [end, error] = std::from_chars(token.text.data() + skip, past, token.integer, base);
    if (end != past) {
      problems_.Warn(place,
                     "'" + token.text + "' is no octal number: what stands behind the 0 ends before its " + *end);
    }
    if (error == std::errc::result_out_of_range) problems_.Add(place, "'" + token.text + "' is too large for 64 bits");
    at_ += length;
    // "100us" is microseconds: a suffix ends the word.
    std::size_t suffix = 0;
    const auto is_one_of = [&](char c, char lower) { return (c | 0x20) == lower; };
    if (is_one_of(At(0), 'u')) suffix = is_one_of(At(1), 'l') ? 2 : 1;
    if (is_one_of(At(0), 'l')) suffix = is_one_of(At(1), 'u') ? 2 : 1;
    if (suffix > 0 && !IsLetter(At(suffix)) && !IsNumeral(At(suffix))) at_ += suffix;
    into_.push_back(std::move(token));
  }

  const std::string& text_;
  Place place_;
  std::vector<Token>& into_;
  Problems& problems_;
  std::size_t at_ = 0;
};

std::string Unquoted(const std::string& text) {
  std::string result;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\' && text[i + 1] == '"' && i + 2 < text.size()) ++i;
    result += text[i];
  }
  return result;
}

std::string Written(const std::string& bytes) {
  std::string result;
  for (const char c : bytes) {
    char text[8];
    std::snprintf(text, sizeof text, "0x%02x", static_cast<unsigned char>(c));
    result += (result.empty() ? "" : " ") + std::string(text);
  }
  return result;
}

}  // namespace

std::string Token::Name() const {
  if (kind == Kind::kEnd) return "the end of the file";
  if (kind == Kind::kPragma) return "#pragma";
  return kind == Kind::kString ? "\"" + text + "\"" : "'" + text + "'";
}

bool IsReserved(std::string_view word) { return std::ranges::find(kReserved, word) != kReserved.end(); }

std::vector<Token> TokensOf(std::vector<TextToken> texts, Problems& problems) {
  std::vector<Token> tokens;
  tokens.reserve(texts.size() + 1);
  Place last;
  for (TextToken& each : texts) {
    last = each.place;
    switch (each.kind) {
      case TextToken::Kind::kWord:
      case TextToken::Kind::kMark: {
        const auto other = std::ranges::find(kOtherSpellings, each.text, &OtherSpelling::from);
        const bool is_other = other != kOtherSpellings.end();
        if (each.text == "#" || each.text == "##" || each.text == "..." || each.text == "%:") {
          problems.Add(each.place, "'" + each.text + "' means nothing here");
          break;
        }
        tokens.push_back({.kind = each.kind == TextToken::Kind::kMark || is_other ? Kind::kMark : Kind::kWord,
                          .text = is_other ? std::string(other->to) : std::move(each.text),
                          .place = each.place});
        break;
      }
      case TextToken::Kind::kNumber:
        NumberCutter(each, tokens, problems).Cut();
        break;
      case TextToken::Kind::kString:
        tokens.push_back({.kind = Kind::kString, .text = Unquoted(each.text), .place = each.place});
        break;
      case TextToken::Kind::kCharacter:
        tokens.push_back(
            {.kind = Kind::kCharacter, .text = each.text.substr(1, each.text.size() - 2), .place = each.place});
        break;
      case TextToken::Kind::kPragma:
        tokens.push_back({.kind = Kind::kPragma, .text = std::move(each.text), .place = each.place});
        break;
      case TextToken::Kind::kStray:
        problems.Add(each.place,
                     static_cast<unsigned char>(each.text[0]) < 0x21 || static_cast<unsigned char>(each.text[0]) > 0x7e
                         ? "the character " + Written(each.text) + " means nothing outside of strings and comments"
                         : "'" + each.text + "' means nothing here");
        break;
      case TextToken::Kind::kEnd:
      case TextToken::Kind::kNewline:
        break;
    }
  }
  tokens.push_back({.kind = Kind::kEnd, .place = last});
  return tokens;
}

}  // namespace runnel::genom
