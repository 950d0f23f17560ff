#pragma once

#include <string>

#include "core/base/error.h"
#include "core/base/exception_text.h"
#include "core/element/configurable.h"
#include "core/element/framework_element.h"

namespace runnel {

/// The exception that is being handled as an error: that of an ElementError, else what
/// DescribeException() says. Precondition: within a catch block. Without memory it says that.
[[nodiscard]] inline Error CaughtError() noexcept {
  try {
    try {
      throw;
    } catch (const ElementError& error) {
      return error.error();
    }
  } catch (...) {
    return {.message = DescribeException()};
  }
}

/// The text format of a parameter's value, for people. A type whose text format throws does not end the whole
/// of what is shown: what it has thrown stands in the place of the value, in brackets.
[[nodiscard]] inline std::string ParameterText(const Configurable& parameter) {
  try {
    return parameter.ToText();
  } catch (...) {
    return "(" + DescribeException() + ")";
  }
}

}  // namespace runnel
