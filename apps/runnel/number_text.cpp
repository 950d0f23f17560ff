#include "apps/runnel/number_text.h"

#include <cstdio>

namespace runnel::program {

std::string NumberText(double number) {
  char text[512];  // the longest double has 309 digits before the point
  std::snprintf(text, sizeof text, number < 100 ? "%.3g" : "%.0f", number);
  return text;
}

}  // namespace runnel::program
