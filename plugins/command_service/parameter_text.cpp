#include "plugins/command_service/parameter_text.h"

#include "core/base/exception_text.h"

namespace runnel {

std::string ParameterText(const Configurable& parameter) {
  try {
    return parameter.ToText();
  } catch (...) {
    return "(" + DescribeException() + ")";
  }
}

}  // namespace runnel
