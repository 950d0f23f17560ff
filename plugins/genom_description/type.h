#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plugins/genom_text/place.h"

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

enum class TypeKind {
  kInvalid,  ///< stands for one whose declaration was wrong, so that its users are not told again
  kBoolean,
  kOctet,
  kCharacter,
  kShort,
  kUnsignedShort,
  kLong,
  kUnsignedLong,
  kLongLong,
  kUnsignedLongLong,
  kFloat,
  kDouble,
  kString,
  kSequence,
  kOptional,
  kArray,
  kEnum,
  kEnumerator,
  kStruct,
  kUnion,
  kException,
  kMember,
  kCase,
  kTypedef,
  kConstant,
  kForwardStruct,
  kForwardUnion,
  kNative,
  kEvent,
  kPauseEvent,
  kPort,
  kRemote
};

struct Scope;

/// Whatever has a name in a scope, and the types without names that these are made of.
struct Type {
  static constexpr std::uint64_t kUnbounded = ~std::uint64_t{0};

  TypeKind kind = TypeKind::kInvalid;
  std::string name = {};       ///< "" without one
  std::string full_name = {};  ///< "::nav::pose"
  Place place = {};
  Type* type =
      nullptr;  ///< of elements, members, aliases, constants; of a union its switch; of an enumerator its enum;
                ///< of a forward declaration what it became
  std::uint64_t length = kUnbounded;  ///< of strings, sequences, arrays
  std::vector<Type*> members = {};    ///< members, cases, enumerators
  Constant value = {};                ///< of a constant
  std::vector<Constant> labels = {};  ///< of a case; kNone stands for default
  Scope* scope = nullptr;             ///< in which its members stand

  [[nodiscard]] bool Is(TypeKind wanted) const { return kind == wanted; }
  /// "nav::pose", or what it is made of: "sequence<long, 4>".
  [[nodiscard]] std::string ShownName() const;
};

/// A scope: modules, components and interfaces, and what has members.
struct Scope {
  std::string name = {};
  std::string full_name = {};  ///< "" for the global one, "::nav"
  Place place = {};
  bool is_module = false;  ///< a module, component or interface
  Scope* parent = nullptr;
  std::map<std::string, Type*, std::less<>> types = {};
  std::map<std::string, Scope*, std::less<>> children = {};  ///< that can be reopened
};

/// "struct", "union member", "unsigned long".
[[nodiscard]] std::string_view NameOf(TypeKind kind);
/// "struct nav::pose".
[[nodiscard]] std::string KindAndName(const Type& type);

/// What the type is behind aliases, members, constants and forward declarations.
[[nodiscard]] Type* FinalType(Type* type);
[[nodiscard]] const Type* FinalType(const Type* type);
/// Whether both stand for the same data.
[[nodiscard]] bool AreSame(const Type* a, const Type* b);
/// The member, case or enumerator of that name, also of what an optional holds; nullptr if there is none.
[[nodiscard]] Type* MemberOf(Type* type, std::string_view name);
/// What an index leads to in an array or sequence; nullptr if it is neither.
[[nodiscard]] Type* ElementOf(Type* type);
/// Whether there is a type within, at any depth, of that kind.
[[nodiscard]] bool Holds(const Type* type, TypeKind kind);
/// Whether something of that type would hold itself, directly or by its members.
[[nodiscard]] bool HoldsItself(const Type* type);

}  // namespace runnel::genom
