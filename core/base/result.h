#pragma once

#include <optional>
#include <utility>
#include <variant>

#include "core/base/check.h"
#include "core/base/error.h"

namespace runnel {

/// A value, or the error that stands in its place. Shaped like C++23's std::expected.
///
///     Result<int> Parse(std::string_view text);
///     if (auto number = Parse(text)) Use(*number); else Report(number.error());
///
/// Errors:  asking for the half that is not there is a programmer's error (RUNNEL_CHECK).
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  [[nodiscard]] bool has_value() const noexcept { return content_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }

  [[nodiscard]] T& value() & { return Checked(); }
  [[nodiscard]] const T& value() const& { return const_cast<Result*>(this)->Checked(); }
  [[nodiscard]] T&& value() && { return std::move(Checked()); }
  T& operator*() & { return Checked(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(Checked()); }
  T* operator->() { return &Checked(); }
  const T* operator->() const { return &value(); }

  [[nodiscard]] const Error& error() const {
    RUNNEL_CHECK(!has_value(), "Result::error() of a success");
    return std::get<1>(content_);
  }

 private:
  T& Checked() {
    if (!has_value()) ThrowProgrammingError("Result has no value", error().ToString());
    return std::get<0>(content_);
  }

  std::variant<T, Error> content_;
};

/// Success without a value, or an error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  [[nodiscard]] bool has_value() const noexcept { return !error_.has_value(); }
  explicit operator bool() const noexcept { return has_value(); }
  [[nodiscard]] const Error& error() const {
    RUNNEL_CHECK(error_.has_value(), "Result::error() of a success");
    return *error_;
  }

 private:
  std::optional<Error> error_;
};

}  // namespace runnel
