#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "plugins/command_service/application_log.h"
#include "plugins/ros_messages/node_messages.h"

namespace runnel {

class FrameworkElement;
class Scheduler;
class Supervisor;

/// How an application is, for /diagnostics: modules that have failed or are stuck, inputs to which nothing new comes
/// (<on_stale>), threads whose cycles end too late. Who has failed is asked of the scheduler, and who is silent of
/// supervision, so that it goes with the module, has its new name, and comes back with it; the log says why one has failed.
///
/// Ownership:  application, scheduler, supervisor and log must outlive it. Copies go on from what has been read.
/// Threads:    one at a time; takes the structure lock, ten times a second at most.
class ApplicationHealth {
 public:
  ApplicationHealth(FrameworkElement& application, Scheduler& scheduler, const Supervisor& supervisor,
                    const ApplicationLog& log)
      : application_(&application), scheduler_(&scheduler), supervisor_(&supervisor), log_(&log) {}

  [[nodiscard]] std::vector<RosDiagnosticStatus> operator()();

 private:
  struct Overruns {
    std::uint64_t count = 0;
    Time since{};  // when there was one, on the application's clock
    bool is_any = false;
  };

  void ReadLog();
  void Look();
  void Add(RosHealth level, const std::string& of, const std::string& message);
  void AddThreads();

  FrameworkElement* application_;
  Scheduler* scheduler_;
  const Supervisor* supervisor_;
  const ApplicationLog* log_;
  std::uint64_t next_in_log_ = 0;
  std::map<std::string, std::string> causes_;  // of modules that have failed once
  std::map<std::string, Overruns> overruns_;   // by thread
  Time looked_{};                              // on the machine's clock
  std::vector<RosDiagnosticStatus> all_;       // as it was then
};

}  // namespace runnel
