#include "bench/report/json_report.h"

#include <cstdio>

#include "bench/report/row.h"

namespace runnel::bench {

namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + '"';
}

std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

std::string Member(const std::string& name, const std::string& value) { return Quoted(name) + ": " + value; }

const char* NameOf(Role role) {
  switch (role) {
    case Role::kRunnel:
      return "runnel";
    case Role::kRival:
      return "rival";
    case Role::kFloor:
      return "floor";
    case Role::kBaseline:
      return "baseline";
  }
  return "";
}

// "a", "b" between `open` and `close`, each on a line of its own.
std::string Listed(const std::vector<std::string>& parts, const char* open, const char* close) {
  std::string text = open;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i > 0 ? ",\n  " : "\n  ") + parts[i];
  return text + "\n " + close;
}

std::string Names(const Measurement& measurement) {
  return Member("workload", Quoted(measurement.workload.name)) + ", " +
         Member("subject", Quoted(measurement.subject.name)) + ", " +
         Member("quantity", Quoted(measurement.quantity.name));
}

std::string CaseToJson(const Measurement& measurement, const Results& results) {
  std::string samples;
  for (const double sample : measurement.samples) {
    samples += (samples.empty() ? "" : ", ") + Number(sample);
  }
  return "{" + Names(measurement) + ", " + Member("group", Quoted(measurement.group)) + ", " +
         Member("role", Quoted(NameOf(measurement.subject.role))) + ", " +
         Member("unit", Quoted(measurement.quantity.unit)) + ", " +
         Member("more_is_better", measurement.quantity.more_is_better ? "true" : "false") + ", " +
         Member("typical", Number(measurement.Typical())) + ", " + Member("median", Number(measurement.Median())) +
         ", " + Member("minimum", Number(measurement.Minimum())) + ", " +
         Member("maximum", Number(measurement.Maximum())) + ", " +
         Member("f", Number(results.FetchAdd(measurement.group))) + ", " +
         Member("quiet", std::to_string(measurement.quiet)) + ", " +
         Member("disturbed", measurement.is_disturbed ? "true" : "false") + ", " +
         Member("error", Quoted(measurement.error)) + ", " + Member("samples", "[" + samples + "]") + "}";
}

std::string RowToJson(const Row& row) {
  std::string verdicts;
  for (const Verdict& verdict : row.verdicts) {
    verdicts += std::string(verdicts.empty() ? "" : ", ") + "{" + Member("bar", Quoted(verdict.bar)) + ", " +
                Member("met", !verdict.is_known ? "null"
                              : verdict.is_met  ? "true"
                                                : "false") +
                "}";
  }
  return "{" + Names(*row.runnel) + ", " + Member("in_f", Number(row.in_f)) + ", " +
         Member("bars", "[" + verdicts + "]") + ", " +
         Member("best_rival", Quoted(row.best_rival != nullptr ? row.best_rival->subject.name : "")) + ", " +
         Member("ratio", Number(row.ratio)) + ", " + Member("wins", Quoted(row.winner)) + "}";
}

}  // namespace

std::string ToJson(const Machine& machine, const Results& results) {
  std::vector<std::string> facts;
  for (const auto& [name, value] : machine.facts) facts.push_back(Member(name, Quoted(value)));
  std::vector<std::string> warnings;
  for (const std::string& warning : machine.warnings) warnings.push_back(Quoted(warning));
  std::vector<std::string> cases;
  for (const Measurement& each : results.all()) cases.push_back(CaseToJson(each, results));
  std::vector<std::string> rows;
  for (const Row& row : MakeRows(results)) rows.push_back(RowToJson(row));
  return "{\n " + Member("machine", Listed(facts, "{", "}")) + ",\n " + Member("warnings", Listed(warnings, "[", "]")) +
         ",\n " + Member("cases", Listed(cases, "[", "]")) + ",\n " + Member("rows", Listed(rows, "[", "]")) + "\n}\n";
}

}  // namespace runnel::bench
