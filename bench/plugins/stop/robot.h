#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/command_service/command_service.h"
#include "plugins/control/control_server.h"
#include "plugins/inspector/inspector.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/web_server/web_server.h"

namespace runnel::bench {

using SteadyClock = std::chrono::steady_clock;

/// Milliseconds since `begin`.
[[nodiscard]] inline double Since(SteadyClock::time_point begin) {
  return std::chrono::duration<double, std::milli>(SteadyClock::now() - begin).count();
}

/// Says why to the person who measures, and ends the program.
[[noreturn]] void Fail(const std::string& why);

/// What is driven.
class Base final : public Module {
 public:
  using Module::Module;
  Input<double> speed{this, "speed", {.unit = "m/s", .drives = true}};

 private:
  void Update() override {}
};

/// What drives, and what is too large for a slow connection.
class Planner final : public Module {
 public:
  using Module::Module;
  Output<double> speed{this, "speed", {.unit = "m/s"}};
  Output<std::vector<std::uint8_t>> picture{this, "picture"};

  void PublishPicture();

 private:
  void Update() override {}
};

/// An application whose bases are driven, and all by which clients reach it: the service, the control socket, the server of
/// the page. The first base is connected to the planner.
struct Robot {
  static constexpr int kBases = 100;  ///< as many dead-men are tried at once

  Robot();
  ~Robot();

  /// Waits until the reader of the first base finds it moving, or finds the safe value.
  void UntilRead(bool is_moving, Duration pause = {}) const;

  Runtime runtime;
  ModuleRegistry modules;
  std::vector<Base*> bases;
  Planner* planner = nullptr;
  Scheduler scheduler{runtime, {}};
  StructureEditor editor{runtime, modules, &scheduler};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  std::unique_ptr<CommandService> service;
  std::filesystem::path folder;  ///< of the socket
  std::unique_ptr<ControlServer> control;
  std::unique_ptr<Inspector> inspector;
  std::unique_ptr<WebServer> web;
};

}  // namespace runnel::bench
