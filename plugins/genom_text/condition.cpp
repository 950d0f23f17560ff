#include "plugins/genom_text/condition.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace runnel::genom {

namespace {

using Kind = TextToken::Kind;

struct Operator {
  std::string_view text;
  int binding;  // the higher, the tighter
};
constexpr std::array<Operator, 18> kOperators = {{{"||", 1}, {"&&", 2}, {"|", 3}, {"^", 4}, {"&", 5},
                                                  {"==", 6}, {"!=", 6}, {"<=", 7}, {">=", 7}, {"<", 7},
                                                  {">", 7}, {"<<", 8}, {">>", 8}, {"+", 9}, {"-", 9},
                                                  {"*", 10}, {"/", 10}, {"%", 10}}};

class ConditionReader {
 public:
  ConditionReader(const std::vector<TextToken>& tokens, Place place, Problems& problems)
      : tokens_(tokens), place_(place), problems_(problems) {}

  std::optional<bool> Value() {
    const std::int64_t value = Ternary();
    if (!is_wrong_ && at_ < tokens_.size()) Fail("this does not belong to the condition");
    if (is_wrong_) return std::nullopt;
    return value != 0;
  }

 private:
  static constexpr int kDeepest = 100;

  void Fail(const std::string& message) {
    if (is_wrong_) return;
    is_wrong_ = true;
    problems_.Add(at_ < tokens_.size() ? tokens_[at_].place : place_, message);
  }
  [[nodiscard]] bool IsMark(std::size_t at, std::string_view text) const {
    return at < tokens_.size() && tokens_[at].kind == Kind::kMark && tokens_[at].text == text;
  }
  // Operators of two characters come as two tokens, but for << and >>.
  [[nodiscard]] const Operator* Next() const {
    if (at_ >= tokens_.size() || tokens_[at_].kind != Kind::kMark) return nullptr;
    std::string both = tokens_[at_].text;
    if (at_ + 1 < tokens_.size() && !tokens_[at_ + 1].has_space_before) both += tokens_[at_ + 1].text;
    for (const Operator& each : kOperators) {
      if (each.text.size() == 2 && (both == each.text || tokens_[at_].text == each.text)) return &each;
    }
    for (const Operator& each : kOperators) {
      if (each.text == tokens_[at_].text) return &each;
    }
    return nullptr;
  }

  std::int64_t Ternary() {
    if (++depth_ > kDeepest) Fail("this condition is nested too deeply");
    std::int64_t value = is_wrong_ ? 0 : Binary(1);
    if (!is_wrong_ && IsMark(at_, "?")) {
      ++at_;
      const std::int64_t yes = Ternary();
      if (!IsMark(at_, ":")) Fail("here ':' is missing");
      ++at_;
      const std::int64_t no = is_wrong_ ? 0 : Ternary();
      value = value != 0 ? yes : no;
    }
    --depth_;
    return value;
  }

  std::int64_t Binary(int binding) {
    std::int64_t left = Unary();
    while (!is_wrong_) {
      const Operator* next = Next();
      if (next == nullptr || next->binding < binding) break;
      at_ += next->text.size() == 2 && tokens_[at_].text.size() == 1 ? 2 : 1;
      left = Apply(next->text, left, Binary(next->binding + 1));
    }
    return left;
  }

  std::int64_t Unary() {
    if (++depth_ > kDeepest) Fail("this condition is nested too deeply");
    std::int64_t value = 0;
    if (is_wrong_) {
    } else if (at_ >= tokens_.size()) {
      Fail("the condition ends too early");
    } else if (IsMark(at_, "!")) {
      ++at_;
      value = Unary() == 0 ? 1 : 0;
    } else if (IsMark(at_, "-")) {
      ++at_;
      value = static_cast<std::int64_t>(0 - static_cast<std::uint64_t>(Unary()));
    } else if (IsMark(at_, "+")) {
      ++at_;
      value = Unary();
    } else if (IsMark(at_, "~")) {
      ++at_;
      value = ~Unary();
    } else if (IsMark(at_, "(")) {
      ++at_;
      value = Ternary();
      if (!IsMark(at_, ")")) Fail("here ')' is missing");
      ++at_;
    } else {
      value = Primary();
    }
    --depth_;
    return value;
  }

  std::int64_t Primary() {
    const TextToken& token = tokens_[at_];
    if (token.kind == Kind::kWord) {
      ++at_;
      return 0;  // no macro
    }
    if (token.kind == Kind::kCharacter && token.text.size() >= 3) {
      ++at_;
      return token.text[1];
    }
    if (token.kind != Kind::kNumber) {
      Fail("a condition is made of whole numbers, macros and 'defined'");
      return 0;
    }
    const bool is_hexadecimal = token.text.starts_with("0x") || token.text.starts_with("0X");
    const int base = is_hexadecimal ? 16 : token.text.starts_with("0") ? 8 : 10;
    std::uint64_t value = 0;
    for (std::size_t i = is_hexadecimal ? 2 : 0; i < token.text.size(); ++i) {
      const char c = static_cast<char>(token.text[i] | 0x20);
      const int numeral = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : 99;
      if (numeral >= base) {
        if (c == 'u' || c == 'l') continue;
        Fail("a condition is made of whole numbers, macros and 'defined'");
        return 0;
      }
      value = value * static_cast<std::uint64_t>(base) + static_cast<std::uint64_t>(numeral);
    }
    ++at_;
    return static_cast<std::int64_t>(value);
  }

  std::int64_t Apply(std::string_view text, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<std::uint64_t>(a);
    const auto ub = static_cast<std::uint64_t>(b);
    if (text == "||") return a != 0 || b != 0;
    if (text == "&&") return a != 0 && b != 0;
    if (text == "|") return a | b;
    if (text == "^") return a ^ b;
    if (text == "&") return a & b;
    if (text == "==") return a == b;
    if (text == "!=") return a != b;
    if (text == "<=") return a <= b;
    if (text == ">=") return a >= b;
    if (text == "<") return a < b;
    if (text == ">") return a > b;
    if (text == "<<") return static_cast<std::int64_t>(ub < 64 ? ua << ub : 0);
    if (text == ">>") return static_cast<std::int64_t>(ub < 64 ? ua >> ub : 0);
    if (text == "+") return static_cast<std::int64_t>(ua + ub);
    if (text == "-") return static_cast<std::int64_t>(ua - ub);
    if (text == "*") return static_cast<std::int64_t>(ua * ub);
    if (b == 0) {
      Fail("this condition divides by zero");
      return 0;
    }
    if (b == -1) return text == "/" ? static_cast<std::int64_t>(0 - ua) : 0;
    return text == "/" ? a / b : a % b;
  }

  const std::vector<TextToken>& tokens_;
  Place place_;
  Problems& problems_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool is_wrong_ = false;
};

}  // namespace

std::optional<bool> ConditionValue(const std::vector<TextToken>& tokens, Place place,
                                   Problems& problems) {
  return ConditionReader(tokens, place, problems).Value();
}

}  // namespace runnel::genom
