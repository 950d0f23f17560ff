#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/characters.h"
#include "plugins/values/json_reader.h"

namespace runnel {

namespace {

// The parser refuses numbers that its floating point type has no room for; 1e999, which stands for infinity, fits
// into this one.
using Json = nlohmann::basic_json<std::map, std::vector, std::string, bool, std::int64_t, std::uint64_t, long double>;

/// Makes tokens of what the parser comes across.
class TokenMaker final : public nlohmann::json_sax<Json> {
 public:
  TokenMaker(std::string_view text, int deepest) : text_(text), tokens_(deepest) {}

  Result<ValueTokens> MakeAll() {
    // Where the parser would take the text for ended, whatever follows.
    if (text_.find('\0') != std::string_view::npos) {
      return runnel::Error{.message = "a JSON text contains a NUL character"};
    }
    if (!Json::sax_parse(text_, this)) return std::move(error_);
    return std::move(tokens_);
  }

  bool null() override { return AddWord("null"); }
  bool boolean(bool is_true) override { return AddWord(is_true ? "true" : "false"); }
  // Whole numbers with a sign; doubles have a 0 of either.
  bool number_integer(std::int64_t number) override { return AddWord(number == 0 ? "-0" : std::to_string(number)); }
  bool number_unsigned(std::uint64_t number) override { return AddWord(std::to_string(number)); }
  bool number_float(long double, const std::string& digits) override {
    std::string word = digits;
    std::ranges::replace(word, ',', '.');  // the parser writes it as the program's locale does
    return AddWord(std::move(word));
  }
  bool string(std::string& text) override { return Add(ValueToken::Kind::kText, std::move(text)); }
  bool key(std::string& name) override { return Add(ValueToken::Kind::kText, std::move(name)); }
  bool binary(Json::binary_t&) override { return false; }  // is in no text
  bool start_object(std::size_t) override { return Begin(ValueToken::Kind::kStructure); }
  bool start_array(std::size_t) override { return Begin(ValueToken::Kind::kList); }
  bool end_object() override { return End(); }
  bool end_array() override { return End(); }

  // `read`: how many bytes, with the one at which it stopped.
  bool parse_error(std::size_t read, const std::string&, const nlohmann::detail::exception& failure) override {
    constexpr std::size_t kShown = 200;
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error …"
    std::string_view message = failure.what();
    message.remove_prefix(message.find("] ") + 2);
    if (message.starts_with("parse error at")) message.remove_prefix(message.find(": ") + 2);
    const std::string_view before = text_.substr(0, read - 1);
    const auto line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
    error_ = {.message = Shortened(std::string(message), kShown),
              .position = {"", 1 + static_cast<int>(std::ranges::count(before, '\n')),
                           1 + static_cast<int>(before.size() - line_begin)}};
    return false;
  }

 private:
  bool AddWord(std::string word) { return Add(ValueToken::Kind::kWord, std::move(word)); }
  bool Add(ValueToken::Kind kind, std::string text) {
    tokens_.Add(kind, std::move(text));
    return true;
  }
  bool Begin(ValueToken::Kind kind) {
    const auto begun = tokens_.Begin(kind);
    if (!begun) error_ = begun.error();
    return begun.has_value();
  }
  bool End() {
    tokens_.End();
    return true;
  }

  const std::string_view text_;
  ValueTokens tokens_;
  Error error_;
};

}  // namespace

Result<JsonPart> JsonPart::Parse(std::string_view text, int deepest) {
  auto made = TokenMaker(text, deepest).MakeAll();
  if (!made) return made.error();
  const auto tokens = std::make_shared<const ValueTokens>(std::move(*made));
  return JsonPart(std::shared_ptr<const ValueToken>(tokens, &tokens->root()));
}

}  // namespace runnel
