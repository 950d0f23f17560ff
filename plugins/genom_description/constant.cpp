#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "plugins/genom_description/type.h"

namespace runnel::genom {

namespace {

using Kind = Constant::Kind;
__extension__ using WideInteger = __int128;  // holds what any two whole numbers make

std::int64_t Signed(const Constant& value) { return static_cast<std::int64_t>(value.whole); }

WideInteger Wide(const Constant& value) {
  return value.kind == Kind::kUnsigned ? static_cast<WideInteger>(value.whole)
                                       : static_cast<WideInteger>(Signed(value));
}

Constant OfReal(double value) { return {.kind = Kind::kReal, .real = value}; }

constexpr double kTwoToThe64 = 18446744073709551616.0;

Computed ComputeReals(double a, char operation, double b) {
  if (std::string_view("+-*/").find(operation) == std::string_view::npos) {
    return {.error = fmt::format("'{}' needs whole numbers", operation)};
  }
  if (operation == '/' && b == 0) return {.error = "this divides by zero"};
  const double result = operation == '+' ? a + b : operation == '-' ? a - b : operation == '*' ? a * b : a / b;
  if (!std::isfinite(result)) return {.error = "the result is too large for a double"};
  return {OfReal(result)};
}

Computed OfWhole(WideInteger result) {
  if (result >= static_cast<WideInteger>(kTwoToThe64) || result < -static_cast<WideInteger>(kTwoToThe64 / 2)) {
    return {.error = "the result has more than 64 bits"};
  }
  return {{.kind = result < 0 ? Kind::kSigned : Kind::kUnsigned, .whole = static_cast<std::uint64_t>(result)}};
}

Computed ComputeWholes(const Constant& a, char operation, const Constant& b) {
  const WideInteger x = Wide(a);
  const WideInteger y = Wide(b);
  WideInteger result = 0;
  switch (operation) {
    case '+':
      result = x + y;
      break;
    case '-':
      result = x - y;
      break;
    case '*':
      if (__builtin_mul_overflow(x, y, &result)) return {.error = "the result has more than 64 bits"};
      break;
    case '|':
      result = x | y;
      break;
    case '&':
      result = x & y;
      break;
    case '^':
      result = x ^ y;
      break;
    default:
      if (y == 0) return {.error = "this divides by zero"};
      result = operation == '/' ? x / y : x % y;
  }
  return OfWhole(result);
}

Computed Shifted(const Constant& a, char operation, const Constant& b) {
  const auto by = Converted(b, Kind::kUnsigned);
  if (!by || (a.kind != Kind::kUnsigned && a.kind != Kind::kSigned)) {
    return {.error = "only whole numbers can be shifted, by whole numbers"};
  }
  const auto places = static_cast<int>(std::min<std::uint64_t>(by->whole, 64));
  if (operation == '>') return OfWhole(Wide(a) >> places);
  if (places == 64 && a.whole != 0) return {.error = "the result has more than 64 bits"};
  return OfWhole(Wide(a) << (places % 64));
}

}  // namespace

double Constant::AsReal() const {
  if (kind == Kind::kReal) return real;
  if (kind == Kind::kUnsigned) return static_cast<double>(whole);
  return kind == Kind::kSigned ? static_cast<double>(Signed(*this)) : 0;
}

std::string Constant::ToText() const {
  switch (kind) {
    case Kind::kNone:
      return "";
    case Kind::kBoolean:
      return boolean ? "TRUE" : "FALSE";
    case Kind::kUnsigned:
      return std::to_string(whole);
    case Kind::kSigned:
      return std::to_string(Signed(*this));
    case Kind::kReal:
      return fmt::format("{}", real);
    case Kind::kString:
      return "\"" + text + "\"";
    case Kind::kCharacter:
      return "'" + text + "'";
    case Kind::kEnumerator:
      return enumerator == nullptr ? "" : enumerator->ShownName();
  }
  return "";
}

std::optional<Constant> Converted(Constant value, Kind kind) {
  if (value.kind == kind) return value;
  if (!value.is_number()) return std::nullopt;
  Constant result{.kind = kind};
  if (kind == Kind::kReal) {
    result.real = value.AsReal();
    return result;
  }
  if (kind != Kind::kUnsigned && kind != Kind::kSigned) return std::nullopt;
  if (value.kind == Kind::kReal) {
    const bool fits = kind == Kind::kUnsigned ? value.real >= 0 && value.real < kTwoToThe64
                                              : value.real >= -kTwoToThe64 / 2 && value.real < kTwoToThe64 / 2;
    if (!fits || std::trunc(value.real) != value.real) return std::nullopt;
    result.whole = kind == Kind::kUnsigned ? static_cast<std::uint64_t>(value.real)
                                           : static_cast<std::uint64_t>(static_cast<std::int64_t>(value.real));
    return result;
  }
  if (kind == Kind::kUnsigned && Signed(value) < 0) return std::nullopt;
  result.whole = value.whole;
  return result;
}

bool AreEqual(const Constant& a, const Constant& b) {
  if (a.is_number() && b.is_number()) {
    if (a.kind == Kind::kReal || b.kind == Kind::kReal) return a.AsReal() == b.AsReal();
    return Wide(a) == Wide(b);
  }
  if (a.kind != b.kind) return false;
  switch (a.kind) {
    case Kind::kBoolean:
      return a.boolean == b.boolean;
    case Kind::kEnumerator:
      return a.enumerator == b.enumerator;
    default:
      return a.text == b.text;
  }
}

Computed Compute(char operation, const Constant& a) {
  if (operation == '~' && a.kind == Kind::kBoolean) return {{.kind = Kind::kBoolean, .boolean = !a.boolean}};
  if (!a.is_number()) return {.error = fmt::format("'{}' needs a number", operation)};
  if (operation == '+') return {a};
  if (a.kind == Kind::kReal) {
    if (operation == '~') return {.error = "'~' needs a whole number"};
    return {OfReal(-a.real)};
  }
  if (operation == '-') return OfWhole(-Wide(a));
  Constant result = a;
  result.whole = ~a.whole;
  return {result};
}

Computed Compute(const Constant& a, char operation, const Constant& b) {
  if (!a.is_number() || !b.is_number()) {
    return {.error = fmt::format("'{}' needs numbers on both sides", operation)};
  }
  if (operation == '<' || operation == '>') return Shifted(a, operation, b);
  if (a.kind == Kind::kReal || b.kind == Kind::kReal) return ComputeReals(a.AsReal(), operation, b.AsReal());
  return ComputeWholes(a, operation, b);
}

}  // namespace runnel::genom
