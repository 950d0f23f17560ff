#include "bench/report/row.h"

namespace runnel::bench {

namespace {

// Closer together than this, nobody wins.
constexpr double kEven = 0.03;

bool IsBetter(const Measurement& one, const Measurement& other) {
  return one.quantity.more_is_better ? one.Typical() > other.Typical() : one.Typical() < other.Typical();
}

const Measurement* BestRival(const Results& results, const Measurement& of) {
  const Measurement* best = nullptr;
  for (const Measurement& each : results.all()) {
    if (each.subject.role != Role::kRival || each.workload.name != of.workload.name ||
        each.quantity.name != of.quantity.name || each.samples.empty()) {
      continue;
    }
    if (best == nullptr || IsBetter(each, *best)) best = &each;
  }
  return best;
}

void Compare(Row& row) {
  const double mine = row.runnel->Typical();
  const double theirs = row.best_rival->Typical();
  if (mine <= 0 || theirs <= 0) return;
  row.ratio = row.runnel->quantity.more_is_better ? mine / theirs : theirs / mine;
  const bool is_even = row.ratio > 1 - kEven && row.ratio < 1 + kEven;
  row.winner = is_even ? "even" : row.ratio > 1 ? "Runnel" : row.best_rival->subject.name;
}

}  // namespace

std::vector<Row> MakeRows(const Results& results) {
  std::vector<Row> rows;
  for (const Measurement& each : results.all()) {
    if (each.subject.role != Role::kRunnel) continue;
    Row row;
    row.runnel = &each;
    const double f = results.FetchAdd(each.group);
    if (each.quantity.unit == "ns" && f > 0) row.in_f = each.Typical() / f;
    for (const Bar& bar : Bars()) {
      if (bar.workload == each.workload.name && bar.subject == each.subject.name &&
          bar.quantity == each.quantity.name) {
        row.verdicts.push_back(Judge(bar, each, results));
      }
    }
    row.best_rival = BestRival(results, each);
    if (row.best_rival != nullptr && !each.samples.empty()) Compare(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace runnel::bench
