#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/lockfree/wake_event.h"
#include "plugins/ros_messages/parameter_messages.h"
#include "plugins/ros_services/service_endpoints.h"

namespace runnel {

class Configurable;
class Logger;

/// A parameter of this application that somebody wants to have another value.
struct ParameterChange {
  std::string path;
  std::string value;  ///< text format
};
/// Sets all of them between two cycles, or none. By a thread of its own, outside of the structure lock.
using ParameterSetter = std::function<Result<void>(const std::vector<ParameterChange>&)>;

/// The parameters of an application as those of one node of ROS 2: its six services, and /parameter_events. "planner.distance"
/// is the parameter /planner/distance.
///
/// Ownership:  application and participant must outlive it. Has a thread of its own, as setting may wait for cycles.
/// Threads:    any.
class ParameterServices {
 public:
  /// `set`: nullptr: they may be looked at only. `log`: what goes wrong. `table`: ServiceTopics::table. Errors: of the engine.
  static Result<std::unique_ptr<ParameterServices>> Start(FrameworkElement& application, const std::string& node,
                                                          WireParticipant& participant, ServiceDialect dialect,
                                                          ParameterSetter set, Logger& log,
                                                          const DiscoveryTable* table = nullptr);
  ~ParameterServices();

  /// That it is to be looked who is there now.
  void LookAgain() { wake_->Notify(); }
  void AddIds(std::vector<WireId>& readers, std::vector<WireId>& writers) const;

  // What the services say; of threads that do not have the structure lock.
  [[nodiscard]] RosListReply List(const RosListRequest& request) const;
  using Names = std::vector<std::string>;
  [[nodiscard]] std::vector<RosParameterValue> Get(const Names& names) const;
  [[nodiscard]] std::vector<RosParameterType> GetTypes(const Names& names) const;
  [[nodiscard]] std::vector<RosParameterDescriptor> DescribeAll(const Names& names) const;
  // `sent`: ServiceMessage::sent.
  using Wanted = std::vector<RosParameter>;
  [[nodiscard]] std::vector<RosSetResult> Set(const Wanted& wanted, Time sent) const;
  [[nodiscard]] RosSetResult SetAtomically(const Wanted& wanted, Time sent) const;

 private:
  struct Server;
  struct Found {
    Configurable* parameter;
    std::string path;
  };
  using Parameters = std::map<std::string, Found>;

  ParameterServices(FrameworkElement& application, std::string node, ServiceDialect dialect, ParameterSetter set,
                    Logger& log, const DiscoveryTable* table);
  template <typename Request, typename Answer>
  Result<void> Add(const char* name, const char* type, WireParticipant& participant, const Answer& answer);
  // Under the structure lock.
  [[nodiscard]] Parameters FindAll() const;
  template <typename Use>
  void ForEach(const Names& names, const Use& use) const;
  [[nodiscard]] std::vector<Result<ParameterChange>> Prepare(const Wanted& wanted) const;
  [[nodiscard]] RosSetResult SetTogether(const std::vector<ParameterChange>& changes, Time sent) const;
  void Run() noexcept;
  void TellChanges();
  [[nodiscard]] std::map<std::string, RosParameterValue> Values() const;

  FrameworkElement& application_;
  const std::string node_;
  const ServiceDialect dialect_;
  const ParameterSetter set_;
  Logger& log_;
  const DiscoveryTable* const table_;
  const std::shared_ptr<WakeEvent> wake_;
  std::vector<std::unique_ptr<Server>> servers_;
  std::unique_ptr<WireWriter> events_;
  std::atomic<std::size_t> listeners_{0};
  std::atomic<bool> ends_{false};
  // The thread's own: as they were at the start, or have been told.
  std::map<std::string, RosParameterValue> told_;
  std::thread thread_;
};

}  // namespace runnel
