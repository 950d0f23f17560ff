#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/port/port.h"
#include "plugins/timing/task_meter.h"

namespace runnel {

class TraceTrack;

/// From which output to which one the age of values is measured: from a sensor's to that of a command.
struct LatencyRequest {
  std::string from;  ///< path of a port
  std::string to;    ///< likewise; what is computed from the first, module by module

  friend bool operator==(const LatencyRequest&, const LatencyRequest&) = default;
};

/// How long the first value of `to` that goes back to a measurement comes after it.
struct Latency {
  LatencyRequest request;
  std::vector<std::string> modules;  ///< on the way, in their order; none: there is no way now
  TaskTimes times;                   ///< `runs`: measurements that have come through
};

/// A chain of modules, with what is known of the values that go along it.
///
/// Measurements are followed by what each module publishes: a value goes back to the newest one that was there when the
/// run of the task began in which it was published.
struct LatencyChain {
  /// What the newest value of an output goes back to. Written by the thread whose cycle has the module.
  struct Point {
    const Port* output = nullptr;
    std::atomic<std::int64_t> measured{0};  ///< on the application's clock
    std::atomic<std::uint64_t> number{0};   ///< of the measurement; 0: none
  };

  LatencyRequest request;
  std::uint64_t name = 0;  ///< by which a trace knows it
  std::vector<std::string> modules;
  const Clock* clock = nullptr;      ///< the application's
  std::vector<Point> points;         ///< outputs, from the first to the last
  std::vector<std::uint64_t> stops;  ///< for each point, the id of the element that publishes it; 0: of none that runs
  std::shared_ptr<TaskMeter> meter;
};

/// What one element has to do with chains: it reads a value of one output and publishes one of the next.
///
/// Threads:    Begin() and End() by the thread whose cycle has the element. Progress: wait-free. Allocation: none.
class ChainSteps {
 public:
  /// `place`: which of the chain's points it publishes.
  void Add(std::shared_ptr<LatencyChain> chain, std::size_t place);

  /// Before and after each of its tasks. `track`: where arrows go; nullptr: nowhere.
  void Begin() const noexcept;
  void End(Time within_task, TraceTrack* track) const noexcept;

 private:
  struct Step {
    std::shared_ptr<LatencyChain> chain;
    std::size_t place;
    // Of the run that is under way, and of those before.
    std::int64_t measured = 0;
    std::uint64_t number = 0;
    std::uint64_t last_number = 0;
    std::uint64_t publications = 0;
  };
  mutable std::vector<Step> steps_;  // the cycle's own
};

/// The elements between two ports, along the data flow, on one of the shortest ways: those that run tasks, each with the
/// output by which it goes on. Under the structure lock.
struct DataPath {
  struct Stop {
    FrameworkElement* element;
    const Port* output;
  };
  std::vector<Stop> stops;  ///< the first publishes `from`, if it runs tasks; the last one publishes `to`
};
/// Errors: no such port; there is no way from the one to the other.
[[nodiscard]] Result<DataPath> FindDataPath(FrameworkElement& root, const LatencyRequest& request);

}  // namespace runnel
