#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// What was measured once: the file that --json wrote.
class EarlierRun {
 public:
  /// Throws std::runtime_error if the file cannot be read.
  explicit EarlierRun(const std::string& file);

  /// Runnel's figures of then and of now, side by side. Figures whose repetitions overlap are called
  /// noise.
  [[nodiscard]] std::string CompareWith(const Results& results) const;

 private:
  struct Case {
    double typical = 0;
    double minimum = 0;
    double maximum = 0;
    double f = 0;
  };
  static std::string KeyOf(const std::string& workload, const std::string& subject, const std::string& quantity) {
    return workload + "/" + subject + "/" + quantity;
  }
  static std::vector<std::string> Cells(const Case& before, const Measurement& now, double f);

  std::map<std::string, Case> cases_;
};

}  // namespace runnel::bench
