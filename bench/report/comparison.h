#pragma once

#include <string>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// Runnel's figures of an earlier run (the file that --json wrote) beside those of this one. Two
/// figures whose repetitions overlap are called noise. Throws std::runtime_error if the file cannot
/// be read.
[[nodiscard]] std::string CompareWithEarlier(const std::string& file, const Results& results);

}  // namespace runnel::bench
