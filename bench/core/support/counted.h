#pragma once

#include <cstddef>
#include <string>

namespace runnel::bench {

/// "1 input", "15 inputs".
inline std::string Counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace runnel::bench
