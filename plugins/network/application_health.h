#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "plugins/ros_messages/node_messages.h"

namespace runnel {

class Application;

/// How an application is, for /diagnostics: modules that a fault has stopped, inputs to which nothing new comes (<on_stale>),
/// threads whose cycles end too late.
///
/// Ownership:  the application must outlive it. Copies begin anew.
/// Threads:    one at a time; takes the structure lock.
class ApplicationHealth {
 public:
  explicit ApplicationHealth(Application& application) : application_(&application) {}

  [[nodiscard]] std::vector<RosDiagnosticStatus> operator()();

 private:
  struct Overruns {
    std::uint64_t count = 0;
    Time since{};  // when there was one, on the application's clock
  };
  void ReadLog();
  void AddThreads(std::vector<RosDiagnosticStatus>& all);

  Application* application_;
  std::uint64_t next_in_log_ = 0;
  std::map<std::string, std::string> stopped_;  // modules, and why
  std::map<std::string, std::string> silent_;   // inputs, and what was said
  std::map<std::string, Overruns> overruns_;    // by thread
};

}  // namespace runnel
