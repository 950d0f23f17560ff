#include "apps/runnel/run_report.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <utility>

#include "core/element/runtime.h"
#include "core/types/duration_text.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel::program {

RunReport::RunReport(FrameworkElement& application) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  application.Visit([this](FrameworkElement& element) {
    if (auto* const monitor = element.FindAnnotation<RunMonitor>()) {
      judges_.push_back({monitor, element.path(), FindSourcePlace(element)});
    }
  });
}

template <typename Use>
auto RunReport::Attempt(Judge& judge, const Use& use)
    -> std::optional<decltype(use(*judge.monitor))> {
  try {
    return use(*judge.monitor);
  } catch (const std::exception& exception) {
    Fail(judge, exception.what());
  } catch (...) {
    Fail(judge, "unknown exception");
  }
  return {};
}

void RunReport::Fail(Judge& judge, const std::string& why) {
  judge.has_failed = true;
  failures_.push_back({.message = "its run monitor has failed: " + why,
                       .path = judge.path,
                       .position = judge.position});
}

std::optional<RunOutcome> RunReport::OutcomeOf(Judge& judge) {
  if (judge.has_failed) return {};
  const auto outcome = Attempt(judge, [](RunMonitor& monitor) { return monitor.Outcome(); });
  return outcome ? *outcome : std::nullopt;
}

std::string RunReport::Progress() {
  std::string text;
  for (Judge& judge : judges_) {
    if (judge.has_failed) continue;
    const auto said = Attempt(judge, [](RunMonitor& monitor) { return monitor.Progress(); });
    if (said) text += (text.empty() ? "" : "; ") + *said;
  }
  return text;
}

void RunReport::Hear(const Fault& fault) {
  for (Judge& judge : judges_) {
    if (judge.path == fault.path) judge.has_failed = true;
  }
}

bool RunReport::IsOver() {
  return !judges_.empty() && std::ranges::all_of(judges_, [this](Judge& judge) {
    return OutcomeOf(judge).has_value() || judge.has_failed;
  });
}

std::string RunReport::Verdicts() {
  std::string text;
  for (Judge& judge : judges_) {
    const auto outcome = OutcomeOf(judge);
    if (!outcome) continue;
    text += outcome->verdict + (outcome->summary.empty() ? "" : ": " + outcome->summary) + "\n";
  }
  return text;
}

bool RunReport::IsGood() {
  return std::ranges::all_of(judges_, [this](Judge& judge) {
    const auto outcome = OutcomeOf(judge);
    return !judge.has_failed && (!outcome || outcome->success);
  });
}

std::string RunReport::Finish(Diagnostics& diagnostics) {
  std::string text;
  for (Judge& judge : judges_) {
    const auto said = Attempt(judge, [](RunMonitor& monitor) { return monitor.Finish(); });
    if (!said) continue;
    if (!*said) {
      Error error = said->error();
      if (error.path.empty()) error.path = judge.path;
      if (error.position.file.empty()) error.position = judge.position;
      diagnostics.Add(std::move(error));
    } else if (!(*said)->empty()) {
      text += **said + ((*said)->back() == '\n' ? "" : "\n");
    }
  }
  for (Error& failure : failures_) diagnostics.Add(std::move(failure));
  failures_.clear();
  return text;
}

std::string FaultText(const Fault& fault, Time start, FrameworkElement& root) {
  const std::lock_guard lock(root.runtime().structure_mutex());
  Diagnostics diagnostics;
  const auto element = root.Find(fault.path);
  diagnostics.Add({.message = "has been stopped: " + fault.message,
                   .path = fault.path,
                   .position = element ? FindSourcePlace(**element) : SourcePosition{},
                   .hint = DurationText(fault.time - start) + " after the start"});
  return diagnostics.ToString();
}

std::string NoticeText(const Notice& notice, Time start, FrameworkElement& root) {
  const std::lock_guard lock(root.runtime().structure_mutex());
  const auto element = root.Find(notice.path);
  Error text{.message = notice.message,
             .path = notice.path,
             .position = element ? FindSourcePlace(**element) : SourcePosition{},
             .hint = DurationText(notice.time - start) + " after the start"};
  Diagnostics diagnostics;
  if (notice.is_failure) {
    diagnostics.Add(std::move(text));
  } else {
    diagnostics.AddWarning(std::move(text));
  }
  return diagnostics.ToString();
}

}  // namespace runnel::program
