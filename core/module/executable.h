#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/element/annotation.h"
#include "core/element/framework_element.h"

namespace runnel {

/// When in a cycle a task runs: what senses before what computes before what controls.
enum class Phase { kSense, kUpdate, kControl };

/// One function of an element that wants to be called once a cycle, and the port groups through
/// which its data comes and goes; an executor orders tasks along them.
struct Task {
  FrameworkElement* element = nullptr;
  Phase phase = Phase::kUpdate;
  std::function<void()> run;
  std::vector<const FrameworkElement*> reads;   ///< groups of inputs
  std::vector<const FrameworkElement*> writes;  ///< groups of outputs
};

/// "I have something to do in each cycle": the annotation by which an executor finds what to run,
/// without the core knowing executors.
///
/// Threads:  tasks() is called under the structure lock; the tasks run in the executor's thread,
///           never two of one element at a time. What they throw is the executor's to catch and
///           report.
class Executable final : public Annotation {
 public:
  /// The groups are asked for late, since ports make them when they are constructed.
  explicit Executable(std::function<std::vector<Task>()> tasks) : tasks_(std::move(tasks)) {}
  [[nodiscard]] std::vector<Task> tasks() const { return tasks_(); }

 private:
  std::function<std::vector<Task>()> tasks_;
};

}  // namespace runnel
