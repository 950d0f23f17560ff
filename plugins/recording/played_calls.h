#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/port/port.h"
#include "plugins/mcap/mcap_reader.h"

namespace runnel {

/// Makes the calls again that came from outside of the application while it was recorded, by terminals, pages, other
/// programs: each in the cycle in which its service began to serve it. Activities that were asked to end are asked in
/// the cycle in which that took effect. What comes of the calls nobody waits for.
///
/// Threads: as Player.
class PlayedCalls {
 public:
  PlayedCalls();
  ~PlayedCalls();

  /// `records`: the port NAME_calls beside a service, in this channel of the recording. False: there is no service.
  bool Add(Port& records, std::uint16_t channel);
  /// All calls between these times of the recording's clock. Errors: what was recorded cannot be read.
  Result<void> Read(McapReader& reader, Time from, Time to);
  /// In front of the tasks of the modules that serve, but of those that do not run.
  void WrapTasks(const std::function<bool(const FrameworkElement& module)>& runs);
  /// From the recording's clock to the application's.
  void Start(Duration offset) noexcept { offset_ = offset; }

  /// How many are made again.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  struct Service;
  class OfModule;

  std::map<std::uint16_t, Service> services_;  // by channels
  std::vector<std::unique_ptr<OfModule>> modules_;
  Duration offset_{};
  std::size_t size_ = 0;
};

}  // namespace runnel
