#include "bench/report/comparison.h"

#include <stdexcept>

#include <boost/property_tree/json_parser.hpp>

#include "bench/report/text.h"

namespace runnel::bench {

namespace {

// Less than this is no difference, even where the repetitions of each run agree.
constexpr double kEven = 0.03;

}  // namespace

EarlierRun::EarlierRun(const std::string& file) try {
  boost::property_tree::ptree root;
  boost::property_tree::read_json(file, root);
  for (const auto& [key, each] : root.get_child("cases")) {
    const auto text = [&tree = each](const char* name) { return tree.get<std::string>(name); };
    const auto number = [&tree = each](const char* name) { return tree.get<double>(name); };
    cases_[KeyOf(text("workload"), text("subject"), text("quantity"))] = {number("typical"), number("minimum"),
                                                                          number("maximum"), number("f")};
  }
} catch (const boost::property_tree::ptree_error& error) {
  throw std::runtime_error(file + " is not what --json wrote: " + error.what());
}

std::vector<std::string> EarlierRun::Cells(const Case& before, const Measurement& now, double f) {
  const std::string& unit = now.quantity.unit;
  const double ratio = now.Typical() / before.typical;
  const bool is_time = unit == "ns" && f > 0 && before.f > 0;
  const bool overlap = before.minimum <= now.Maximum() && now.Minimum() <= before.maximum;
  const bool is_even = ratio > 1 - kEven && ratio < 1 + kEven;
  const bool is_better = (ratio > 1) == now.quantity.more_is_better;
  return {now.workload.name + ": " + now.subject.name + ", " + now.quantity.name,
          WithUnit(before.typical, unit),
          WithUnit(now.Typical(), unit),
          Rounded(ratio),
          is_time ? Rounded(ratio * before.f / f) : "",
          is_even     ? "even"
          : overlap   ? "noise: the ranges overlap"
          : is_better ? "better"
                      : "WORSE"};
}

std::string EarlierRun::CompareWith(const Results& results) const {
  TextTable table({"Runnel", "old", "new", "new / old", "in f", "verdict"});
  for (const Measurement& each : results.all()) {
    if (each.subject.role != Role::kRunnel || each.samples.empty()) continue;
    const auto before = cases_.find(KeyOf(each.workload.name, each.subject.name, each.quantity.name));
    if (before == cases_.end() || before->second.typical <= 0) continue;
    table.Add(Cells(before->second, each, results.FetchAdd(each.group)));
  }
  return table.ToString();
}

}  // namespace runnel::bench
