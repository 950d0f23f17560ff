#include "plugins/application/run_report.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/exception_text.h"
#include "core/element/runtime.h"
#include "core/types/duration_text.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel {

RunReport::RunReport(Runtime& runtime) : runtime_(runtime) {
  const std::lock_guard lock(runtime_.structure_mutex());
  OnReady(runtime_.root());
  runtime_.AddListener(*this);
}

RunReport::~RunReport() { runtime_.RemoveListener(*this); }

void RunReport::OnReady(FrameworkElement& ready) {
  ready.Visit([this](FrameworkElement& element) {
    auto* const monitor = element.FindAnnotation<RunMonitor>();
    if (monitor == nullptr || std::ranges::count(judges_, &element, &Judge::element) > 0) return;
    judges_.push_back({monitor, &element, element.path(), FindSourcePlace(element)});
  });
}

void RunReport::OnDeleted(FrameworkElement& element) {
  std::erase_if(judges_, [&](const Judge& each) { return each.element->IsAtOrBelow(element); });
}

template <typename Use>
auto RunReport::Attempt(Judge& judge, const Use& use)
    -> std::optional<decltype(use(*judge.monitor))> {
  try {
    return use(*judge.monitor);
  } catch (...) {
    Fail(judge, DescribeException());
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
  const std::lock_guard lock(runtime_.structure_mutex());
  std::string text;
  for (Judge& judge : judges_) {
    if (judge.has_failed) continue;
    const auto said = Attempt(judge, [](RunMonitor& monitor) { return monitor.Progress(); });
    if (said) text += (text.empty() ? "" : "; ") + *said;
  }
  return text;
}

void RunReport::Hear(const Fault& fault) {
  if (fault.is_mended) return;
  const std::lock_guard lock(runtime_.structure_mutex());
  for (Judge& judge : judges_) {
    if (judge.path == fault.path) judge.has_failed = true;
  }
}

bool RunReport::IsOver() {
  const std::lock_guard lock(runtime_.structure_mutex());
  return !judges_.empty() && std::ranges::all_of(judges_, [this](Judge& judge) {
    return OutcomeOf(judge).has_value() || judge.has_failed;
  });
}

std::string RunReport::Verdicts() {
  const std::lock_guard lock(runtime_.structure_mutex());
  std::string text;
  for (Judge& judge : judges_) {
    const auto outcome = OutcomeOf(judge);
    if (!outcome) continue;
    text += outcome->verdict + (outcome->summary.empty() ? "" : ": " + outcome->summary) + "\n";
  }
  return text;
}

bool RunReport::IsGood() {
  const std::lock_guard lock(runtime_.structure_mutex());
  return std::ranges::all_of(judges_, [this](Judge& judge) {
    const auto outcome = OutcomeOf(judge);
    return !judge.has_failed && (!outcome || outcome->success);
  });
}

std::string RunReport::Finish(Diagnostics& diagnostics) {
  const std::lock_guard lock(runtime_.structure_mutex());
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
  const auto element = root.Find(fault.path);
  Error text{.message = "has been stopped: " + fault.message,
             .path = fault.path,
             .position = element ? FindSourcePlace(**element) : SourcePosition{},
             .hint = DurationText(fault.time - start) + " after the start"};
  Diagnostics diagnostics;
  if (fault.is_mended) {
    diagnostics.AddWarning(std::move(text));
  } else {
    diagnostics.Add(std::move(text));
  }
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

}  // namespace runnel
