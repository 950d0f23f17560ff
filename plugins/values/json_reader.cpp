#include "plugins/values/json_reader.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/values/internal/json_number.h"

namespace runnel {

std::optional<bool> JsonPart::boolean() const {
  if (IsWord("true")) return true;
  return IsWord("false") ? std::optional(false) : std::nullopt;
}

std::optional<std::string> JsonPart::text() const {
  return Is(ValueToken::Kind::kText) ? std::optional(token_->text) : std::nullopt;
}

std::optional<double> JsonPart::number() const { return internal::NumberOf<double>(*token_); }

std::optional<std::uint64_t> JsonPart::count() const {
  return Is(ValueToken::Kind::kWord) ? NumberIn<std::uint64_t>(token_->text) : std::nullopt;
}

std::vector<JsonPart> JsonPart::items() const {
  std::vector<JsonPart> items;
  if (!is_list()) return items;
  const ValueToken* item = token_->First();
  for (; items.size() < token_->count; item = item->Next()) items.push_back(Part(item));
  return items;
}

std::vector<std::pair<std::string, JsonPart>> JsonPart::members() const {
  std::vector<std::pair<std::string, JsonPart>> members;
  if (!is_object()) return members;
  const ValueToken* name = token_->First();
  for (; members.size() * 2 < token_->count; name = name->Next()->Next()) {
    members.emplace_back(name->text, Part(name->Next()));
  }
  return members;
}

const JsonPart* JsonMembers::Find(const std::string& name) {
  known_.push_back(name);
  const auto found =
      std::ranges::find(members_, name, [](const auto& each) -> const std::string& { return each.first; });
  return found == members_.end() ? nullptr : &found->second;
}

template <typename Get>
auto JsonMembers::Take(const std::string& name, const std::string& what, const Get& get)
    -> decltype(get(std::declval<const JsonPart&>())) {
  const JsonPart* const found = Find(name);
  if (found == nullptr || found->is_null()) return {};
  auto value = get(*found);
  if (!value) Complain("\"" + name + "\" must be " + what);
  return value;
}

std::optional<std::string> JsonMembers::Text(const std::string& name) {
  return Take(name, "a text", [](const JsonPart& part) { return part.text(); });
}

std::optional<double> JsonMembers::Number(const std::string& name) {
  return Take(name, "a number, not below 0", [](const JsonPart& part) {
    const auto number = part.number();
    return number && std::isfinite(*number) && *number >= 0 ? number : std::nullopt;
  });
}

std::optional<std::uint64_t> JsonMembers::Count(const std::string& name, std::uint64_t most) {
  return Take(name, "a count, at most " + std::to_string(most), [most](const JsonPart& part) {
    const auto count = part.count();
    return count && *count <= most ? count : std::nullopt;
  });
}

std::optional<bool> JsonMembers::Flag(const std::string& name) {
  return Take(name, "true or false", [](const JsonPart& part) { return part.boolean(); });
}

std::optional<std::vector<JsonPart>> JsonMembers::List(const std::string& name) {
  return Take(name, "a list",
              [](const JsonPart& part) { return part.is_list() ? std::optional(part.items()) : std::nullopt; });
}

std::vector<std::string> JsonMembers::NeedTexts(const std::string& name) {
  std::vector<std::string> texts;
  for (const JsonPart& each : NeedList(name)) {
    auto text = each.text();
    if (!text) Complain("\"" + name + "\" must be a list of texts");
    texts.push_back(std::move(text).value_or(""));
  }
  return texts;
}

void JsonMembers::RefuseOthers() {
  const std::vector<std::string> known = known_;
  for (const auto& [name, value] : members_) {
    if (std::ranges::find(known, name) != known.end()) continue;
    return Complain("has no \"" + name + "\"", NearestNameHint(name, known));
  }
}

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
