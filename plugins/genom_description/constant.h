#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace runnel::genom {

struct Type;

/// The value of an expression.
struct Constant {
  enum class Kind { kNone, kBoolean, kUnsigned, kSigned, kReal, kString, kCharacter, kEnumerator };

  [[nodiscard]] bool is_number() const {
    return kind == Kind::kUnsigned || kind == Kind::kSigned || kind == Kind::kReal;
  }
  [[nodiscard]] double AsReal() const;
  /// For people: "4", "\"text\"", "nav::left".
  [[nodiscard]] std::string ToText() const;

  Kind kind = Kind::kNone;
  bool boolean = false;
  std::uint64_t whole = 0;  ///< of kUnsigned; of kSigned in two's complement
  double real = 0;
  std::string text = {};
  const Type* enumerator = nullptr;
};

/// The constant as one of the other kind; nullopt where that has no such value: 1.5 as a whole number, -1 as an
/// unsigned one, a boolean as a number.
[[nodiscard]] std::optional<Constant> Converted(Constant value, Constant::Kind kind);
[[nodiscard]] bool AreEqual(const Constant& a, const Constant& b);

/// What an operator makes of its operands; an error message where it makes nothing.
struct Computed {
  Constant value = {};
  std::string error = {};
};
[[nodiscard]] Computed Compute(char operation, const Constant& a);
/// '<' and '>' shift.
[[nodiscard]] Computed Compute(const Constant& a, char operation, const Constant& b);

}  // namespace runnel::genom
