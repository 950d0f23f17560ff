#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace runnel::bench {

/// What a case stands for in the table.
enum class Role {
  kRunnel,
  kRival,     ///< does the same work in another way: who is best of these is who is to be beaten
  kFloor,     ///< the work alone, with nothing that would make it safe between threads
  kBaseline,  ///< what the others are divided by
};

struct Quantity {
  std::string name;
  std::string unit;
  bool more_is_better = false;
};
inline Quantity TimeQuantity() { return {"time", "ns"}; }

/// The same work for all cases that belong to it.
struct Workload {
  std::string name;
  std::vector<Quantity> quantities = {TimeQuantity()};
  /// For charts of what a parameter changes: workloads of one family differ in `position` only.
  std::string family = {};
  std::string axis = {};
  double position = 0;
};

/// Who did it.
struct Subject {
  Role role = Role::kRival;
  std::string name;
};

/// One quantity of one case, as often as it was repeated.
struct Measurement {
  std::string group;  ///< cases of one group are measured in turns, each with its own `f`
  Workload workload;
  Subject subject;
  Quantity quantity;
  std::vector<double> samples;
  std::string error = {};  ///< why there are no samples

  bool best_counts = false;  ///< see Typical()

  /// For each sample how slow the core was, before or after (ProbeCore()); empty if not probed.
  std::vector<double> probes = {};
  /// Set by KeepQuiet(): how many samples were quiet, and whether these were too few.
  std::size_t quiet = 0;
  bool is_disturbed = false;

  /// The median; the best of all, if that is what counts: on a machine that others use. All four: 0
  /// without samples.
  [[nodiscard]] double Typical() const;
  [[nodiscard]] double Median() const;
  [[nodiscard]] double Minimum() const;
  [[nodiscard]] double Maximum() const;
};

/// All that was measured, in the order of the cases.
class Results {
 public:
  void Add(Measurement measurement) { all_.push_back(std::move(measurement)); }
  [[nodiscard]] const std::vector<Measurement>& all() const noexcept { return all_; }
  [[nodiscard]] std::vector<Measurement>& all() noexcept { return all_; }
  /// nullptr if it was not measured, or failed.
  [[nodiscard]] const Measurement* Find(const std::string& workload, const std::string& subject,
                                        const std::string& quantity) const;
  /// Nanoseconds of one uncontended fetch_add, measured in turns with the cases of `group`.
  [[nodiscard]] double FetchAdd(const std::string& group) const;

 private:
  std::vector<Measurement> all_;
};

inline const std::string kBaselineWorkload = "baseline";
inline const std::string kFetchAdd = "f: uncontended atomic fetch_add";

}  // namespace runnel::bench
