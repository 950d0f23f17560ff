#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "core/types/type_of.h"

namespace runnel {

/// A value of some described type, or none; shared, and never changed.
///
/// Allocates when it is made of a value.
class AnyValue {
 public:
  AnyValue() = default;
  template <typename T>
  requires(!std::is_same_v<std::remove_cvref_t<T>, AnyValue>) AnyValue(T value)
      : type_(&TypeOf<T>()), value_(std::make_shared<const T>(std::move(value))) {}
  AnyValue(const TypeInfo& type, std::shared_ptr<const void> value) : type_(&type), value_(std::move(value)) {}

  explicit operator bool() const noexcept { return value_ != nullptr; }
  /// Precondition: there is a value.
  [[nodiscard]] const TypeInfo& type() const noexcept { return *type_; }
  [[nodiscard]] const void* get() const noexcept { return value_.get(); }

 private:
  const TypeInfo* type_ = nullptr;
  std::shared_ptr<const void> value_;
};

}  // namespace runnel
