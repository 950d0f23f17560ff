#include "bench/report/comparison.h"

#include <stdexcept>

#include <boost/property_tree/json_parser.hpp>

#include "bench/report/text.h"

namespace runnel::bench {

namespace {

using Tree = boost::property_tree::ptree;

const Tree* FindCase(const Tree& cases, const Measurement& measurement) {
  for (const auto& [key, each] : cases) {
    if (each.get<std::string>("workload") == measurement.workload.name &&
        each.get<std::string>("subject") == measurement.subject.name &&
        each.get<std::string>("quantity") == measurement.quantity.name) {
      return &each;
    }
  }
  return nullptr;
}

std::string Judgement(const Measurement& now, double ratio, const Tree& before) {
  const bool overlap = before.get<double>("minimum") <= now.Maximum() &&
                       now.Minimum() <= before.get<double>("maximum");
  if (overlap) return "noise: the ranges overlap";
  return (ratio > 1) == now.quantity.more_is_better ? "better" : "WORSE";
}

std::vector<std::string> Cells(const Measurement& now, const Tree& before, double f) {
  const std::string& unit = now.quantity.unit;
  const double old = before.get<double>("typical");
  const double old_f = before.get<double>("f");
  const double ratio = old > 0 ? now.Typical() / old : 0;
  const bool is_time = unit == "ns" && f > 0 && old_f > 0;
  return {now.workload.name + ": " + now.subject.name + ", " + now.quantity.name,
          WithUnit(old, unit),
          WithUnit(now.Typical(), unit),
          Rounded(ratio),
          is_time ? Rounded(ratio * old_f / f) : "",
          Judgement(now, ratio, before)};
}

}  // namespace

std::string CompareWithEarlier(const std::string& file, const Results& results) {
  Tree root;
  try {
    boost::property_tree::read_json(file, root);
  } catch (const boost::property_tree::json_parser_error& error) {
    throw std::runtime_error(error.what());
  }
  const Tree& cases = root.get_child("cases");
  TextTable table({"Runnel", "old", "new", "new / old", "in f", "verdict"});
  for (const Measurement& each : results.all()) {
    if (each.subject.role != Role::kRunnel || each.samples.empty()) continue;
    const Tree* before = FindCase(cases, each);
    if (before == nullptr || before->get<double>("typical") <= 0) continue;
    table.Add(Cells(each, *before, results.FetchAdd(each.group)));
  }
  return table.ToString();
}

}  // namespace runnel::bench
