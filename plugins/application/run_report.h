#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/element/runtime.h"
#include "core/log/log_sink.h"
#include "core/module/run_monitor.h"
#include "plugins/scheduling/fault.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel {

/// What the modules that judge a run have to say, all of them together. A monitor that throws,
/// or whose module does, has failed: it comes to no verdict any more, and the
/// run is not a good one. Modules may come and go meanwhile.
///
/// Threads:  all but what a listener is told by one thread, which takes the structure lock: no monitor
///           goes while it is being asked.
class RunReport final : public ElementListener {
 public:
  /// Looks for run monitors in the runtime, which must outlive this.
  explicit RunReport(Runtime& runtime);
  ~RunReport() override;
  RunReport(const RunReport&) = delete;
  RunReport& operator=(const RunReport&) = delete;

  /// "2.31 m to the goal, following"; several separated by "; ".
  [[nodiscard]] std::string Progress();
  /// A fault has happened.
  void Hear(const Fault& fault);
  /// All have come to a verdict or failed, and there is at least one.
  [[nodiscard]] bool IsOver();
  /// The verdicts, one line each: "reached: 12.3 m in 45.6 s". "" if there is none yet.
  [[nodiscard]] std::string Verdicts();
  /// No verdict is a bad one, and no monitor has failed.
  [[nodiscard]] bool IsGood();
  /// After the last cycle: what the monitors have written, one line each. What could not be written
  /// goes to `diagnostics`, as does what they have thrown. Call once.
  [[nodiscard]] std::string Finish(Diagnostics& diagnostics);

  void OnReady(FrameworkElement& element) override;
  void OnDeleted(FrameworkElement& element) override;

 private:
  struct Source {
    RunMonitor* monitor;
    const FrameworkElement* element;
    std::string path;
    SourcePosition position;
    bool has_failed = false;
  };

  /// What `use` makes of the monitor; nothing if that throws, which has failed for good then unless memory was short.
  template <typename Use>
  auto Attempt(Source& source, const Use& use) -> std::optional<decltype(use(*source.monitor))>;
  void Fail(Source& source, const std::string& why);
  [[nodiscard]] std::optional<RunOutcome> OutcomeOf(Source& source);

  Runtime& runtime_;
  std::vector<Source> sources_;  // guarded by the structure lock
  std::vector<Error> failures_;
};

/// "app.xml:3:5: error: /demo/x: has failed: boom; 1.25 s after the start". Takes the
/// structure lock.
[[nodiscard]] std::string FaultText(const Fault& fault, Time start, FrameworkElement& root);

/// "    1.25s  warning  /demo/x: no echo for 2.5 s".
[[nodiscard]] std::string MessageText(const LogMessage& message, Time start);

/// "app.xml:58:3: warning: /demo/x/in: nothing new for 0.3 s; switched …". Takes the structure lock.
[[nodiscard]] std::string NoticeText(const Notice& notice, Time start, FrameworkElement& root);

}  // namespace runnel
