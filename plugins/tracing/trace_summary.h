#pragma once

#include <cstdint>

namespace runnel {

/// What a trace has come to.
struct TraceSummary {
  std::uint64_t events = 0;    ///< in the file
  std::uint64_t lost = 0;      ///< as they came faster than they could be written down
  std::uint64_t left_out = 0;  ///< as the file was as long as it may be, or could not be written
};

}  // namespace runnel
