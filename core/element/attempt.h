#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "core/base/error.h"
#include "core/element/configurable.h"
#include "core/element/framework_element.h"

namespace runnel {

/// The exception that is being handled as an error: that of an ElementError, else what
/// DescribeException() says, with the texts `before` before it. Precondition: within a catch block.
/// Errors:     std::bad_alloc, only if there are such texts.
template <typename... Texts>
[[nodiscard]] Error CaughtError(const Texts&... before) {
  try {
    try {
      throw;
    } catch (const ElementError& error) {
      return error.error();
    }
  } catch (...) {
    std::string what = DescribeException();
    if constexpr (sizeof...(before) > 0) what.insert(0, (std::string().append(before) + ...));
    return {.message = std::move(what)};
  }
}

/// What `act` gives, which is a Result. What it throws is an error of that, as by CaughtError().
template <typename Act, typename... Texts>
[[nodiscard]] std::invoke_result_t<const Act&> Attempt(const Act& act, const Texts&... before) {
  try {
    return act();
  } catch (...) {
    return CaughtError(before...);
  }
}

/// The text format of a parameter's value, for people. A type whose text format throws does not end the whole
/// of what is shown: what it has thrown stands in the place of the value, in brackets.
[[nodiscard]] inline std::string ParameterText(const Configurable& parameter) {
  const auto text = Attempt([&]() -> Result<std::string> { return parameter.ToText(); });
  return text ? *text : "(" + text.error().message + ")";
}

}  // namespace runnel
