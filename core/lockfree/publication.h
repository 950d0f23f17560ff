#pragma once

#include <cstdint>

namespace runnel {

/// Where a value stands among the publications of its source.
struct Publication {
  std::int64_t timestamp = 0;         ///< ns, when the value was measured; if nobody said: publication_time
  std::uint64_t sequence = 0;         ///< 1 for the first publication of the source
  std::uint64_t order = 0;            ///< among sources that share an input; 0 if this source shares none
  std::int64_t publication_time = 0;  ///< ns, the time of the cycle that published it
};

}  // namespace runnel
