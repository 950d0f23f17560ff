#include "plugins/application/run_report.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "core/element/file_notes.h"
#include "core/types/duration_text.h"

namespace runnel {

namespace {

// What has happened to the element of the path.
std::string EventText(Error text, Time time, Time start, bool is_warning, FrameworkElement& root) {
  const std::lock_guard lock(root.runtime().structure_mutex());
  if (const auto element = root.Find(text.path)) text.position = FindSourcePlace(**element);
  text.hint = DurationText(time - start) + " after the start";
  Diagnostics diagnostics;
  is_warning ? diagnostics.AddWarning(std::move(text)) : diagnostics.Add(std::move(text));
  return diagnostics.ToString();
}

}  // namespace

RunReport::RunReport(Runtime& runtime) : runtime_(runtime) {
  const std::lock_guard lock(runtime_.structure_mutex());
  OnReady(runtime_.root());
  runtime_.AddListener(*this);
}

RunReport::~RunReport() { runtime_.RemoveListener(*this); }

void RunReport::OnReady(FrameworkElement& ready) {
  ready.Visit([this](FrameworkElement& element) {
    auto* const monitor = element.FindAnnotation<RunMonitor>();
    if (monitor == nullptr || std::ranges::count(sources_, &element, &Source::element) > 0) return;
    sources_.push_back({monitor, &element, element.path(), FindSourcePlace(element)});
  });
}

void RunReport::OnDeleted(FrameworkElement& element) {
  std::erase_if(sources_, [&](const Source& each) { return each.element->IsAtOrBelow(element); });
}

template <typename Use>
auto RunReport::Attempt(Source& source, const Use& use) -> std::optional<decltype(use(*source.monitor))> {
  try {
    return use(*source.monitor);
  } catch (const std::bad_alloc&) {  // that is no fault of the monitor, which can be asked again
  } catch (...) {
    Fail(source, DescribeException());
  }
  return {};
}

void RunReport::Fail(Source& source, const std::string& why) {
  source.has_failed = true;
  failures_.push_back(
      {.message = "its run monitor has failed: " + why, .path = source.path, .position = source.position});
}

std::optional<RunOutcome> RunReport::OutcomeOf(Source& source) {
  if (source.has_failed) return {};
  const auto outcome = Attempt(source, [](RunMonitor& monitor) { return monitor.Outcome(); });
  return outcome ? *outcome : std::nullopt;
}

std::string RunReport::Progress() {
  const std::lock_guard lock(runtime_.structure_mutex());
  std::string text;
  for (Source& source : sources_) {
    if (source.has_failed) continue;
    const auto said = Attempt(source, [](RunMonitor& monitor) { return monitor.Progress(); });
    if (said) text += (text.empty() ? "" : "; ") + *said;
  }
  return text;
}

void RunReport::Hear(const Fault& fault) {
  if (fault.is_mended || fault.kind != Fault::Kind::kThrown) return;
  const std::lock_guard lock(runtime_.structure_mutex());
  for (Source& source : sources_) {
    if (source.path == fault.path) source.has_failed = true;
  }
}

bool RunReport::IsOver() {
  const std::lock_guard lock(runtime_.structure_mutex());
  return !sources_.empty() && std::ranges::all_of(sources_, [this](Source& source) {
    return OutcomeOf(source).has_value() || source.has_failed;
  });
}

std::string RunReport::Verdicts() {
  const std::lock_guard lock(runtime_.structure_mutex());
  std::string text;
  for (Source& source : sources_) {
    const auto outcome = OutcomeOf(source);
    if (!outcome) continue;
    text += outcome->verdict + (outcome->summary.empty() ? "" : ": " + outcome->summary) + "\n";
  }
  return text;
}

bool RunReport::IsGood() {
  const std::lock_guard lock(runtime_.structure_mutex());
  return std::ranges::all_of(sources_, [this](Source& source) {
    const auto outcome = OutcomeOf(source);
    return !source.has_failed && (!outcome || outcome->success);
  });
}

std::string RunReport::Finish(Diagnostics& diagnostics) {
  const std::lock_guard lock(runtime_.structure_mutex());
  std::string text;
  for (Source& source : sources_) {
    const auto said = Attempt(source, [](RunMonitor& monitor) { return monitor.Finish(); });
    if (!said && !source.has_failed) Fail(source, "out of memory");
    if (!said) continue;
    if (!*said) {
      diagnostics.Add(said->error().WithPath(source.path).WithPosition(source.position));
    } else if (!(*said)->empty()) {
      text += **said + ((*said)->back() == '\n' ? "" : "\n");
    }
  }
  for (Error& failure : failures_) diagnostics.Add(std::move(failure));
  failures_.clear();
  return text;
}

std::string FaultText(const Fault& fault, Time start, FrameworkElement& root) {
  return EventText(
      {.message = (fault.kind == Fault::Kind::kThrown ? "has failed: " : "") + fault.message, .path = fault.path},
      fault.time, start, fault.is_mended, root);
}

std::string MessageText(const LogMessage& message, Time start) {
  return fmt::format("{:>9}  {}\n", DurationText(message.time - start), message.ToString());
}

std::string NoticeText(const Notice& notice, Time start, FrameworkElement& root) {
  return EventText({.message = notice.message, .path = notice.path}, notice.time, start, !notice.is_failure, root);
}

}  // namespace runnel
