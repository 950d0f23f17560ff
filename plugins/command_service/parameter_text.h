#pragma once

#include <string>

#include "core/base/exception_text.h"
#include "core/element/configurable.h"

namespace runnel {

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
