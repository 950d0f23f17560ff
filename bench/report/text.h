#pragma once

#include <string>
#include <vector>

namespace runnel::bench {

/// Three digits that count: 0.0123, 4.56, 789, 12300.
[[nodiscard]] std::string Rounded(double value);
/// With its unit, in one that makes it easy to read: 1.2 ms instead of 1200000 ns.
[[nodiscard]] std::string WithUnit(double value, const std::string& unit);

/// As short as they can be, for the ticks of an axis: 1, 2.5, 10k, 1M.
[[nodiscard]] std::string Short(double value);
[[nodiscard]] std::string ShortWithUnit(double value, const std::string& unit);

/// Columns as wide as what is in them; the first line is the head.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) : lines_{std::move(head)} {}
  void Add(std::vector<std::string> line) { lines_.push_back(std::move(line)); }
  [[nodiscard]] std::string ToString() const;

 private:
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace runnel::bench
