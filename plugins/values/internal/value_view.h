#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <string_view>

#include "core/types/leaf_types.h"
#include "core/types/type_info.h"

namespace runnel::internal {

/// A value that is only looked at, by its description. Whoever asks for a field, an element or a number has made
/// sure that the type has it.
class ValueView {
 public:
  ValueView(const TypeInfo& type, const void* value) : type_(&type), value_(ForLooking(value)) {}

  [[nodiscard]] const TypeInfo& type() const noexcept { return *type_; }
  [[nodiscard]] const void* value() const noexcept { return value_; }
  [[nodiscard]] ValueView Field(std::string_view name) const {
    const FieldInfo* const field = type_->FindField(name);
    return {*field->type, field->address(value_)};
  }
  [[nodiscard]] std::size_t size() const { return type_->elements().columns(value_); }
  [[nodiscard]] ValueView operator[](std::size_t index) const {
    return {*type_->elements().type, type_->elements().element(value_, index)};
  }
  [[nodiscard]] double number() const {
    return WithLeafType(*type_, [this]<typename T>(std::type_identity<T>) -> double {
      if constexpr (std::is_arithmetic_v<T>)
        return static_cast<double>(*static_cast<const T*>(value_));
      return 0;
    });
  }

 private:
  const TypeInfo* type_;
  void* value_;
};

[[nodiscard]] inline bool IsNumber(const TypeInfo& type) {
  return type.kind() == TypeKind::kLeaf &&
         WithLeafType(type, []<typename T>(std::type_identity<T>) {
           return std::is_arithmetic_v<T> && !std::same_as<T, bool>;
         });
}

/// Whether it is a structure with numbers of these names.
[[nodiscard]] inline bool HasNumbers(const TypeInfo& type,
                                     std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const FieldInfo* const field = type.FindField(name);
    if (field == nullptr || !IsNumber(*field->type)) return false;
  }
  return true;
}

/// What the list of this name has as elements; nullptr if there is no such list.
[[nodiscard]] inline const TypeInfo* ElementsOf(const TypeInfo& type, std::string_view list) {
  const FieldInfo* const field = type.FindField(list);
  const bool is_list = field != nullptr && field->type->kind() == TypeKind::kSequence;
  return is_list ? field->type->elements().type : nullptr;
}

}  // namespace runnel::internal
