#include "apps/runnel/run_report.h"

#include <algorithm>

#include "core/types/duration_text.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel::program {

RunReport::RunReport(FrameworkElement& application) {
  application.Visit([this](FrameworkElement& element) {
    if (auto* const monitor = element.FindAnnotation<RunMonitor>()) monitors_.push_back(monitor);
  });
}

std::string RunReport::Progress() const {
  std::string text;
  for (const RunMonitor* monitor : monitors_) {
    text += (text.empty() ? "" : "; ") + monitor->Progress();
  }
  return text;
}

bool RunReport::IsOver() const {
  return !monitors_.empty() && std::ranges::all_of(monitors_, [](const RunMonitor* monitor) {
    return monitor->Outcome().has_value();
  });
}

std::string RunReport::Verdicts() const {
  std::string text;
  for (const RunMonitor* monitor : monitors_) {
    const auto outcome = monitor->Outcome();
    if (!outcome) continue;
    text += outcome->verdict + (outcome->summary.empty() ? "" : ": " + outcome->summary) + "\n";
  }
  return text;
}

bool RunReport::IsGood() const {
  return std::ranges::all_of(monitors_, [](const RunMonitor* monitor) {
    const auto outcome = monitor->Outcome();
    return !outcome || outcome->success;
  });
}

std::string RunReport::Finish(Diagnostics& diagnostics) {
  std::string text;
  for (RunMonitor* monitor : monitors_) {
    const auto said = monitor->Finish();
    if (!said) {
      diagnostics.Add(said.error());
    } else if (!said->empty()) {
      text += *said + (said->back() == '\n' ? "" : "\n");
    }
  }
  return text;
}

std::string FaultText(const Fault& fault, Time start, FrameworkElement& root) {
  Diagnostics diagnostics;
  const auto element = root.Find(fault.path);
  diagnostics.Add({.message = "has been stopped: " + fault.message,
                   .path = fault.path,
                   .position = element ? FindSourcePlace(**element) : SourcePosition{},
                   .hint = DurationText(fault.time - start) + " after the start"});
  return diagnostics.ToString();
}

}  // namespace runnel::program
