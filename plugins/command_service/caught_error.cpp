#include "plugins/command_service/caught_error.h"

#include "core/base/exception_text.h"
#include "core/element/framework_element.h"

namespace runnel {

Error CaughtError() noexcept {
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

std::string ParameterText(const Configurable& parameter) {
  try {
    return parameter.ToText();
  } catch (...) {
    return "(" + DescribeException() + ")";
  }
}

}  // namespace runnel
