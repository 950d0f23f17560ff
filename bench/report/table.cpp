#include "bench/report/table.h"

#include <set>

#include "bench/report/row.h"
#include "bench/report/text.h"

namespace runnel::bench {

namespace {

std::string Multiple(double ratio) { return ratio > 0 ? Rounded(ratio) : ""; }

std::string NameOf(const Measurement& measurement) {
  const bool is_time = measurement.quantity.name == TimeQuantity().name;
  return measurement.workload.name + ": " + measurement.subject.name +
         (is_time ? "" : ", " + measurement.quantity.name);
}

std::string TypicalOf(const Measurement& measurement) {
  return (measurement.is_disturbed ? "~" : "") + WithUnit(measurement.Typical(), measurement.quantity.unit);
}

std::vector<std::string> Cells(const Row& row) {
  std::string bars;
  std::string met;
  for (const Verdict& verdict : row.verdicts) {
    const std::string separator = bars.empty() ? "" : ", ";
    bars += separator + verdict.bar;
    met += separator + (!verdict.is_known ? "?" : verdict.is_met ? "yes" : "NO");
  }
  const Measurement& mine = *row.runnel;
  return {NameOf(mine),
          mine.samples.empty() ? "failed" : TypicalOf(mine),
          Multiple(row.in_f),
          bars,
          met,
          row.best_rival == nullptr ? "" : row.best_rival->subject.name + " " + TypicalOf(*row.best_rival),
          Multiple(row.ratio),
          row.winner};
}

struct Score {
  int bars = 0;
  int met = 0;
  int contests = 0;
  int won = 0;
};

Score Count(const std::vector<Row>& rows) {
  Score score;
  for (const Row& row : rows) {
    for (const Verdict& verdict : row.verdicts) {
      score.bars += verdict.is_known ? 1 : 0;
      score.met += verdict.is_met ? 1 : 0;
    }
    score.contests += row.winner.empty() ? 0 : 1;
    score.won += row.winner == "Runnel" ? 1 : 0;
  }
  return score;
}

}  // namespace

std::string BaselineTable(const Results& results) {
  TextTable table({"baseline", "median", "in f"});
  std::set<std::string> seen;  // f is measured with every group
  for (const Measurement& each : results.all()) {
    if (each.subject.role != Role::kBaseline || !seen.insert(each.subject.name).second) continue;
    const double f = results.FetchAdd(each.group);
    table.Add({each.subject.name, TypicalOf(each), Multiple(f > 0 ? each.Typical() / f : 0)});
  }
  return table.ToString();
}

std::string MainTable(const Results& results) {
  const std::vector<Row> rows = MakeRows(results);
  if (rows.empty()) return "";
  TextTable table({"workload: by", "Runnel", "in f", "bar", "met?", "best rival", "ratio", "wins"});
  for (const Row& row : rows) table.Add(Cells(row));
  const Score score = Count(rows);
  return table.ToString() + "\n" + std::to_string(score.met) + " of " + std::to_string(score.bars) +
         " bars met; Runnel is ahead in " + std::to_string(score.won) + " of " + std::to_string(score.contests) +
         " comparisons. A ratio above 1: Runnel is better.\n";
}

std::string CaseTable(const Results& results) {
  TextTable table({"case", "median", "from", "to", "quiet"});
  for (const Measurement& each : results.all()) {
    const std::string& unit = each.quantity.unit;
    table.Add({NameOf(each), WithUnit(each.Median(), unit), WithUnit(each.Minimum(), unit),
               WithUnit(each.Maximum(), unit), each.probes.empty() ? "" : std::to_string(each.quiet)});
  }
  return table.ToString();
}

std::string Failures(const Results& results) {
  std::string text;
  for (const Measurement& each : results.all()) {
    if (!each.error.empty()) text += "failed: " + NameOf(each) + ": " + each.error + "\n";
  }
  return text;
}

}  // namespace runnel::bench
