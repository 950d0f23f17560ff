#pragma once

#include <string>
#include <utility>
#include <vector>

namespace runnel::bench {

/// What a figure is worth nothing without: where and how it was measured.
struct Machine {
  std::vector<std::pair<std::string, std::string>> facts;
  std::vector<std::string> warnings;  ///< why the figures may not be trusted

  [[nodiscard]] std::string ToString() const;
};

/// As it is now.
[[nodiscard]] Machine ThisMachine();
/// Of the last minute.
[[nodiscard]] double LoadAverage();

}  // namespace runnel::bench
