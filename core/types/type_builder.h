#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/types/type_info.h"

namespace runnel {

template <typename T>
[[gnu::visibility("hidden")]] const TypeInfo& TypeOf();

/// What is to be said about a field beside its name.
struct FieldOptions {
  std::string unit = {};
  std::string description = {};
};

namespace internal {

// GCC and Clang end it with "kNamed = &runnel::Pose2::heading]".
template <auto kNamed>
[[nodiscard]] constexpr const char* FunctionOf() {
  return __PRETTY_FUNCTION__;
}

// "heading" of what a compiler says of `&Pose2::heading` or of a member `heading_`, "near_by" of `Approach::kNearBy`.
[[nodiscard]] std::string NameIn(std::string_view function);

}  // namespace internal

/// Writes the description of T. The author of a type puts beside it, in its namespace (or in
/// runnel, for types of others):
///
///     inline void Describe(TypeBuilder<Pose2>& type) {
///       type.Name("Pose2").Fields<&Pose2::x, &Pose2::y>({.unit = "m"}).Field("heading", &Pose2::heading,
///           {.unit = "rad"});
///     }
///     inline void Describe(TypeBuilder<Side>& type) {
///       type.Name("Side").Value("left", Side::kLeft).Value("right", Side::kRight);
///     }
///
/// A name alone makes the type opaque: ports carry it, nobody looks inside.
template <typename T>
class TypeBuilder {
 public:
  explicit TypeBuilder(TypeInfo& type) : type_(type) {
    if constexpr (std::is_default_constructible_v<T>) {
      type_.make_ = []() -> void* { return new T(); };
      type_.delete_ = [](void* value) { delete static_cast<T*>(value); };
    }
  }

  TypeBuilder& Name(std::string name) {
    type_.name_ = std::move(name);
    return *this;
  }

  /// What a value stands for, so that viewers can draw it: a word of core/types/README.md, whose
  /// fields T then has.
  TypeBuilder& SemanticTag(std::string tag) {
    type_.semantic_tag_ = std::move(tag);
    return *this;
  }

  /// A public member of T or of a base class.
  template <typename Member, typename Owner>
  requires std::derived_from<T, Owner> TypeBuilder& Field(std::string name, Member Owner::*member,
                                                          FieldOptions options = {}) {
    type_.AddField(std::move(name), TypeOf<Member>(), std::move(options),
                   FieldAddress(std::type_identity<T>(), member));
    return *this;
  }

  /// Several, each with its own name, without a '_' at the end: Fields<&Pose2::x, &Pose2::y>({.unit = "m"}).
  template <auto... kMembers>
  TypeBuilder& Fields(const FieldOptions& options = {}) {
    (Field(internal::NameIn(internal::FunctionOf<kMembers>()), kMembers, options), ...);
    return *this;
  }

  TypeBuilder& Value(std::string name, T value) requires std::is_enum_v<T> {
    type_.kind_ = TypeKind::kEnumeration;
    type_.enumeration_ = {[](const void* at) { return static_cast<std::int64_t>(*static_cast<const T*>(at)); },
                          [](void* at, std::int64_t number) { *static_cast<T*>(at) = static_cast<T>(number); }};
    type_.enumerators_.push_back({std::move(name), static_cast<std::int64_t>(value)});
    return *this;
  }

  /// Several, by their own names: Values<Side::kLeft, Side::kFarRight>() are "left" and "far_right".
  template <auto... kValues>
  TypeBuilder& Values() {
    (Value(internal::NameIn(internal::FunctionOf<kValues>()), kValues), ...);
    return *this;
  }

  /// For types with a text format of their own.
  TypeBuilder& Leaf(const LeafOperations& operations) {
    type_.kind_ = TypeKind::kLeaf;
    type_.leaf_ = operations;
    type_.leaf_.copy = [](void* to, const void* from) { *static_cast<T*>(to) = *static_cast<const T*>(from); };
    return *this;
  }
  /// For containers. `kind` is kSequence or kMatrix.
  TypeBuilder& Elements(TypeKind kind, const ElementOperations& operations) {
    type_.kind_ = kind;
    type_.elements_ = operations;
    return *this;
  }

 private:
  TypeInfo& type_;
};

}  // namespace runnel
