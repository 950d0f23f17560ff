#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/element/framework_element.h"
#include "core/module/run_monitor.h"
#include "plugins/scheduling/fault.h"

namespace runnel::program {

/// What the modules that judge a run have to say, all of them together.
class RunReport {
 public:
  /// Looks for run monitors at and below `application`, which must outlive this.
  explicit RunReport(FrameworkElement& application);

  /// "2.31 m to the goal, following"; several separated by "; ".
  [[nodiscard]] std::string Progress() const;
  /// All have come to a verdict, and there is at least one.
  [[nodiscard]] bool IsOver() const;
  /// The verdicts, one line each: "reached: 12.3 m in 45.6 s". "" if there is none yet.
  [[nodiscard]] std::string Verdicts() const;
  /// No verdict is a bad one.
  [[nodiscard]] bool IsGood() const;
  /// After the last cycle: what the monitors have written, one line each. What could not be written
  /// goes to `diagnostics`. Call once.
  [[nodiscard]] std::string Finish(Diagnostics& diagnostics);

 private:
  std::vector<RunMonitor*> monitors_;
};

/// "app.xml:3:5: error: /demo/x: has been stopped: boom; 1.25 s after the start".
[[nodiscard]] std::string FaultText(const Fault& fault, Time start, FrameworkElement& root);

}  // namespace runnel::program
