#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "plugins/genom_text/preprocessor.h"

namespace runnel::genom {

namespace {

using Kind = TextToken::Kind;

using Number = std::uint64_t;  // as #if computes: 64 bits, in two's complement
std::int64_t Signed(Number number) { return static_cast<std::int64_t>(number); }

struct Operator {
  std::string_view text;
  int binding;                          // the higher, the tighter
  Number (*apply)(Number a, Number b);  // nullptr: divides
};
// Those of two characters first, for they begin like others.
constexpr std::array<Operator, 18> kOperators = {
    {{"||", 1, [](Number a, Number b) -> Number { return a != 0 || b != 0; }},
     {"&&", 2, [](Number a, Number b) -> Number { return a != 0 && b != 0; }},
     {"==", 6, [](Number a, Number b) -> Number { return a == b; }},
     {"!=", 6, [](Number a, Number b) -> Number { return a != b; }},
     {"<=", 7, [](Number a, Number b) -> Number { return Signed(a) <= Signed(b); }},
     {">=", 7, [](Number a, Number b) -> Number { return Signed(a) >= Signed(b); }},
     {"<<", 8, [](Number a, Number b) -> Number { return b < 64 ? a << b : 0; }},
     {">>", 8, [](Number a, Number b) { return static_cast<Number>(Signed(a) >> std::min<Number>(b, 63)); }},
     {"|", 3, [](Number a, Number b) { return a | b; }},
     {"^", 4, [](Number a, Number b) { return a ^ b; }},
     {"&", 5, [](Number a, Number b) { return a & b; }},
     {"<", 7, [](Number a, Number b) -> Number { return Signed(a) < Signed(b); }},
     {">", 7, [](Number a, Number b) -> Number { return Signed(a) > Signed(b); }},
     {"+", 9, [](Number a, Number b) { return a + b; }},
     {"-", 9, [](Number a, Number b) { return a - b; }},
     {"*", 10, [](Number a, Number b) { return a * b; }},
     {"/", 10, nullptr},
     {"%", 10, nullptr}}};

class ConditionReader {
 public:
  ConditionReader(const std::vector<TextToken>& tokens, Place place, Problems& problems)
      : tokens_(tokens), place_(place), problems_(problems) {}

  std::optional<bool> Value() {
    const Number value = Ternary();
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
  bool Accept(std::string_view mark) {
    const bool is_there = at_ < tokens_.size() && tokens_[at_].kind == Kind::kMark && tokens_[at_].text == mark;
    if (is_there) ++at_;
    return is_there;
  }
  // Operators of two characters come as two tokens, but for << and >>.
  [[nodiscard]] const Operator* Next() const {
    if (at_ >= tokens_.size() || tokens_[at_].kind != Kind::kMark) return nullptr;
    std::string both = tokens_[at_].text;
    if (at_ + 1 < tokens_.size() && !tokens_[at_ + 1].has_space_before) both += tokens_[at_ + 1].text;
    for (const Operator& each : kOperators) {
      if (each.text == tokens_[at_].text || each.text == both) return &each;
    }
    return nullptr;
  }

  Number Ternary() {
    if (++depth_ > kDeepest) Fail("this condition is nested too deeply");
    Number value = is_wrong_ ? 0 : Binary(1);
    if (!is_wrong_ && Accept("?")) {
      const Number yes = TernaryIf(value != 0);
      if (!Accept(":")) Fail("here ':' is missing");
      const Number no = is_wrong_ ? 0 : TernaryIf(value == 0);
      value = value != 0 ? yes : no;
    }
    --depth_;
    return value;
  }

  Number TernaryIf(bool counts) {
    unused_ += counts ? 0 : 1;
    const Number value = Ternary();
    unused_ -= counts ? 0 : 1;
    return value;
  }

  Number Binary(int binding) {
    Number left = Unary();
    while (!is_wrong_) {
      const Operator* next = Next();
      if (next == nullptr || next->binding < binding) break;
      at_ += next->text.size() == 2 && tokens_[at_].text.size() == 1 ? 2 : 1;
      const bool is_known = left == 0 ? next->text == "&&" : next->text == "||";
      unused_ += is_known ? 1 : 0;
      const Number right = Binary(next->binding + 1);
      unused_ -= is_known ? 1 : 0;
      left = next->apply != nullptr ? next->apply(left, right) : Divided(Signed(left), next->text, Signed(right));
    }
    return left;
  }

  Number Unary() {
    if (++depth_ > kDeepest) Fail("this condition is nested too deeply");
    Number value = 0;
    if (is_wrong_) {
    } else if (at_ >= tokens_.size()) {
      Fail("the condition ends too early");
    } else if (Accept("!")) {
      value = Unary() == 0 ? 1 : 0;
    } else if (Accept("-")) {
      value = 0 - Unary();
    } else if (Accept("+")) {
      value = Unary();
    } else if (Accept("~")) {
      value = ~Unary();
    } else if (Accept("(")) {
      value = Ternary();
      if (!Accept(")")) Fail("here ')' is missing");
    } else {
      value = Primary();
    }
    --depth_;
    return value;
  }

  Number Primary() {
    const TextToken& token = tokens_[at_];
    if (token.kind == Kind::kWord) {
      ++at_;
      return 0;  // no macro
    }
    if (token.kind == Kind::kCharacter && token.text.size() >= 3) {
      ++at_;
      return static_cast<Number>(token.text[1]);
    }
    // With a base as in C: what stands behind is u or l.
    char* end = nullptr;
    const Number value = token.kind == Kind::kNumber ? std::strtoull(token.text.c_str(), &end, 0) : 0;
    if (end == nullptr || std::string_view(end).find_first_not_of("uUlL") != std::string_view::npos) {
      Fail("a condition is made of whole numbers, macros and 'defined'");
      return 0;
    }
    ++at_;
    return value;
  }

  Number Divided(std::int64_t a, std::string_view operation, std::int64_t b) {
    if (b == 0) {
      if (unused_ == 0) Fail("this condition divides by zero");
      return 0;
    }
    if (b == -1) return operation == "/" ? 0 - static_cast<Number>(a) : 0;  // the least has no opposite
    return static_cast<Number>(operation == "/" ? a / b : a % b);
  }

  const std::vector<TextToken>& tokens_;
  Place place_;
  Problems& problems_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int unused_ = 0;  // within so many parts that change nothing, such as what is behind "0 &&"
  bool is_wrong_ = false;
};

}  // namespace

std::optional<bool> ConditionValue(const std::vector<TextToken>& tokens, Place place, Problems& problems) {
  return ConditionReader(tokens, place, problems).Value();
}

}  // namespace runnel::genom
