#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/clock.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

class FrameworkElement;

/// Who has it written down what cycles do, and gives out the numbers by which that is done. Must outlive
/// the scheduler and the runtime.
class CycleTracer {
 public:
  /// Where the cycles of a thread container are noted; the same for the same container. Under the
  /// structure lock.
  [[nodiscard]] virtual TraceTrack& TrackOf(std::uint64_t id, const std::string& path) = 0;
  /// An element is going to be run. Under the structure lock.
  [[nodiscard]] virtual std::unique_ptr<TracedElement> Watch(FrameworkElement& element) = 0;
  /// By which arrows of this name are noted. Any thread.
  [[nodiscard]] virtual std::uint64_t NumberOf(const std::string& name) = 0;
  /// A thread has been kept between two cycles, from about `began` to `ended` of the machine's clock.
  /// Outside of cycles, by whoever has kept it.
  virtual void OnHold(const std::string& path, Time began, Time ended) noexcept = 0;

 protected:
  virtual ~CycleTracer() = default;
};

}  // namespace runnel
