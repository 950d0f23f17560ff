#include "apps/runnel/print_error.h"

#include <iostream>

#include "core/base/diagnostics.h"

namespace runnel::program {

void PrintError(const Error& error) {
  Diagnostics diagnostics;
  diagnostics.Add(error);
  std::cerr << diagnostics.ToString();
}

}  // namespace runnel::program
