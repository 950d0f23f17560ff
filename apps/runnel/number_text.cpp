#include "apps/runnel/number_text.h"

#include <fmt/format.h>

namespace runnel::program {

std::string NumberText(double number) {
  return number < 100 ? fmt::format("{:.3g}", number) : fmt::format("{:.0f}", number);
}

}  // namespace runnel::program
