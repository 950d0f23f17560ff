#pragma once

#include <atomic>
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

/// Set when what goes on beside the tries is to end.
inline std::atomic<bool> loads_end{false};

/// So long, or until loads end.
void Nap(Duration time);

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

/// Drives in each cycle, from which it returns after 2 s.
class SlowPlanner final : public Module {
 public:
  using Module::Module;
  Output<double> speed{this, "speed", {.unit = "m/s"}};

 private:
  void Update() override {
    speed.Publish(0.4);
    Nap(std::chrono::seconds(2));
  }
};

/// Who drives the bases.
enum class Driver {
  kPlanner,       ///< the first one, when the bench has it publish
  kSlowPlanners,  ///< each has a slow planner in a thread of its own
};

/// An application whose bases are driven, and all by which clients reach it: the service, the control socket, the server of
/// the page.
struct Robot {
  static constexpr std::size_t kBases = 100;  ///< as many dead-men are tried at once

  explicit Robot(Driver driver = Driver::kPlanner);
  ~Robot();

  /// Waits until the readers of all bases that are driven find them moving.
  void Drive();
  /// Waits until they find the safe value; when each of them did.
  std::vector<SteadyClock::time_point> UntilSafe(Duration pause = {}) const;

  const Driver driver;
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
