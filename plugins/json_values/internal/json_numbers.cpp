#include "plugins/json_values/internal/json_numbers.h"

#include <string>

#include <locale.h>
#include <stdlib.h>

namespace runnel {

double DoubleOf(std::string_view digits) {
  double number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (read.ec == std::errc()) return number;
  // Beyond what a double can say; this tells whether it is huge or tiny, whatever the program's locale.
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(std::string(digits).c_str(), nullptr, plain);
}

}  // namespace runnel
