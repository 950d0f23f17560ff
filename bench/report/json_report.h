#pragma once

#include <string>

#include "bench/report/machine.h"
#include "bench/report/measurement.h"

namespace runnel::bench {

/// Everything: the machine, each case with all its samples, each row of the table.
[[nodiscard]] std::string ToJson(const Machine& machine, const Results& results);

}  // namespace runnel::bench
