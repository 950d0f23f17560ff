#include "core/types/internal/text_tokens.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace runnel {

namespace {

constexpr std::string_view kWhitespace = " \t\r\n";

/// White space before anything that is taken does not count.
class TextParser {
 public:
  explicit TextParser(std::string_view text) : all_(text), rest_(text) {}

  Result<ValueTokens> ParseAll() {
    if (auto value = TakeValue(); !value) return value.error();
    if (!Rest().empty()) return ErrorExpecting("the end");
    return std::move(tokens_);
  }

 private:
  using Kind = ValueToken::Kind;

  Result<void> TakeValue() {
    if (Skip('{')) return TakeInside(Kind::kStructure, '}');
    if (Skip('[')) return TakeInside(Kind::kList, ']');
    if (Rest().starts_with('"')) return TakeQuoted();
    const std::string_view word = rest_.substr(0, rest_.find_first_of(",:]}"));
    rest_.remove_prefix(word.size());
    tokens_.Add(Kind::kWord, std::string(WithoutWhitespace(word)));
    return {};
  }

  Result<void> TakeInside(Kind kind, char end) {
    if (auto begun = tokens_.Begin(kind); !begun) return begun;
    if (!Skip(end)) {
      do {
        if (kind == Kind::kStructure) {
          if (auto name = TakeName(); !name) return name;
        }
        if (auto value = TakeValue(); !value) return value;
      } while (Skip(','));
      if (!Skip(end)) return ErrorExpecting(std::string("',' or '") + end + "'");
    }
    tokens_.End();
    return {};
  }

  // Letters, digits and underscores, and the colon.
  Result<void> TakeName() {
    const auto end = std::ranges::find_if_not(Rest(), [](unsigned char character) {
      return std::isalnum(character) != 0 || character == '_';
    });
    const std::string name(rest_.begin(), end);
    rest_.remove_prefix(name.size());
    tokens_.Add(Kind::kText, name);
    return Skip(':') ? Result<void>() : ErrorExpecting("':' after '" + name + "'");
  }

  Result<void> TakeQuoted() {
    constexpr std::string_view kNames = "ntr", kMeant = "\n\t\r";
    std::string text;
    std::size_t i = 1;
    for (; i < rest_.size() && rest_[i] != '"'; ++i) {
      const bool is_escaped = rest_[i] == '\\';
      if (is_escaped && ++i == rest_.size()) break;
      const std::size_t named = is_escaped ? kNames.find(rest_[i]) : std::string_view::npos;
      text += named != std::string_view::npos ? kMeant[named] : rest_[i];
    }
    if (i >= rest_.size()) return ErrorExpecting("a text in quotation marks");
    rest_.remove_prefix(i + 1);
    tokens_.Add(Kind::kText, std::move(text));
    return {};
  }

  // What has not been taken, without white space before it.
  std::string_view Rest() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kWhitespace), rest_.size()));
    return rest_;
  }

  bool Skip(char character) {
    if (!Rest().starts_with(character)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  Error ErrorExpecting(const std::string& what) {
    const std::string where = Rest().empty() ? "at the end" : "before '" + std::string(rest_) + "'";
    return {.message = "expected " + what + " " + where + " of '" + std::string(all_) + "'"};
  }

  const std::string_view all_;
  std::string_view rest_;
  ValueTokens tokens_;
};

}  // namespace

std::string_view WithoutWhitespace(std::string_view text) {
  const auto begin = text.find_first_not_of(kWhitespace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhitespace) - begin + 1);
}

Result<ValueTokens> TokensOf(std::string_view text) { return TextParser(text).ParseAll(); }

}  // namespace runnel
