#include "core/base/check.h"

#include <string>

namespace runnel {

void ThrowProgrammingError(std::string_view what, std::string_view detail) {
  throw ProgrammingError(std::string(what) + " (" + std::string(detail) + ")");
}

}  // namespace runnel
