#pragma once

#include "core/module/module.h"

namespace runnel {

/// A module with two directions of data, as FINROC and MCA2 know them: sensor data flows up through
/// Sense(), commands flow down through Control(), and in one cycle all sensing comes first.
///
///     Input<RangeScan> raw{sensor_inputs(), "raw"};
///     Output<double> distance{sensor_outputs(), "distance"};
///     Input<Twist2> wanted{controller_inputs(), "wanted"};
///     Output<WheelSpeeds> wheels{controller_outputs(), "wheels"};
///
/// What Control() publishes is as old as what Sense() has read in the same cycle, too.
///
/// Life, threads, errors: see Module; Sense() and Control() are never called at the same time.
class SenseControlModule : public Module {
 public:
  explicit SenseControlModule(const Placement& placement);
  ~SenseControlModule() override;

  /// Ports of such a module say on which side they are: both throw ProgrammingError.
  [[nodiscard]] FrameworkElement& InputGroup() final;
  [[nodiscard]] FrameworkElement& OutputGroup() final;

  [[nodiscard]] FrameworkElement& sensor_inputs() { return LazyGroup(groups_[0], "sensor_input"); }
  [[nodiscard]] FrameworkElement& sensor_outputs() { return LazyGroup(groups_[1], "sensor_output"); }
  [[nodiscard]] FrameworkElement& controller_inputs() { return LazyGroup(groups_[2], "controller_input"); }
  [[nodiscard]] FrameworkElement& controller_outputs() { return LazyGroup(groups_[3], "controller_output"); }

 protected:
  virtual void Sense() = 0;
  virtual void Control() = 0;

 private:
  void Update() final {}  // never called: Sense() and Control() are the tasks
  void TellAndSense();
  void SenseAndNote();
  void AgeAndControl();

  Time sensed_ = Time::max();  // the oldest measurement of this cycle
  std::unique_ptr<PortGroup> groups_[4];
};

}  // namespace runnel
