#include "bench/plugins/stop/robot.h"

#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>

#include "plugins/inspector/page/inspector_page.h"

namespace runnel::bench {

namespace {

using namespace std::chrono_literals;

/// Takes its time to be made.
class Slow final : public Module {
 public:
  explicit Slow(const Placement& placement) : Module(placement) { Nap(5s); }

 private:
  void Update() override {}
};

template <typename T>
void Register(ModuleRegistry& modules, const std::string& name) {
  const auto make = [](const Placement& placement) {
    return std::unique_ptr<FrameworkElement>(std::make_unique<T>(placement));
  };
  if (!modules.Add({name, "", "bench", make})) Fail("cannot register " + name);
}

ServiceHooks SlowHooks() {
  return {.load_plugins =
              [](const ChangeSet& changes) {
                const auto* const create = std::get_if<CreateModule>(&changes.front());
                if (create != nullptr && create->type.starts_with("elsewhere/")) Nap(5s);
              },
          .save = [](const std::string&) -> Result<std::string> {
            Nap(5s);
            return std::string("saved");
          }};
}

template <typename T>
T Started(Result<T> started) {
  if (!started) Fail(started.error().ToString());
  return std::move(*started);
}

}  // namespace

void Fail(const std::string& why) {
  std::fprintf(stderr, "bench_stop: %s\n", why.c_str());
  std::exit(1);
}

void Nap(Duration time) {
  for (const auto until = SteadyClock::now() + time; !loads_end && SteadyClock::now() < until;)
    std::this_thread::sleep_for(5ms);
}

void Planner::PublishPicture() {
  auto loan = picture.Loan();
  loan->assign(1'000'000, 7);
  picture.Publish(std::move(loan));
}

Robot::Robot(Driver by) : driver(by) {
  Register<Base>(modules, "bench/base");
  Register<Slow>(modules, "bench/slow");
  Register<SlowPlanner>(modules, "bench/slow_planner");
  for (std::size_t i = 0; i < kBases; ++i) {
    bases.push_back(&runtime.Create<Base>(runtime.root(), "base" + std::to_string(i)));
  }
  planner = &runtime.Create<Planner>(runtime.root(), "planner");
  if (driver == Driver::kPlanner && !Port::Connect(planner->speed, bases.front()->speed)) Fail("cannot connect");
  if (!runtime.MakeReady(runtime.root())) Fail("cannot begin");
  if (driver == Driver::kSlowPlanners) {
    ChangeSet changes;
    for (std::size_t i = 0; i < kBases; ++i) {
      const std::string number = std::to_string(i);
      changes.push_back(AddThread{"own" + number, {.period = 10ms}});
      changes.push_back(CreateModule{"/slow" + number, "bench/slow_planner"});
      changes.push_back(AssignToThread{"/slow" + number, "own" + number});
      changes.push_back(ConnectPorts{"/slow" + number + "/speed", "/base" + number + "/speed"});
    }
    if (const ChangeOutcome done = editor.Apply(changes); !done) Fail(done.diagnostics.ToString());
    if (const auto started = scheduler.Start(); !started) Fail(started.error().ToString());
  }
  service = std::make_unique<CommandService>(
      ServedApplication{runtime, modules, editor, log, SlowHooks(), &history, &scheduler.pace(), &scheduler});
  std::string name = (std::filesystem::temp_directory_path() / "bench_stop_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) Fail("cannot make " + name);
  folder = name;
  control = Started(ControlServer::Start(*service, {.application = "bench", .folder = folder}));
  inspector = std::make_unique<Inspector>(*service, scheduler, InspectorOptions{.application = "bench"});
  web = Started(WebServer::Start({.port = 0}, InspectorPage(), {inspector->Protocol()}));
}

Robot::~Robot() {
  loads_end = true;  // nor is a slow planner waited for
  if (driver == Driver::kSlowPlanners) scheduler.Stop();
  std::filesystem::remove_all(folder);
}

void Robot::Drive() {
  const std::size_t driven = driver == Driver::kPlanner ? 1 : bases.size();
  if (driver == Driver::kPlanner) planner->speed.Publish(0.4);
  const auto limit = SteadyClock::now() + 10s;
  for (std::size_t i = 0; i < driven;) {
    if (SteadyClock::now() > limit) Fail("the robot does not move");
    if (bases[i]->speed.Get() != 0) {
      ++i;
    } else if (driver != Driver::kPlanner) {
      std::this_thread::sleep_for(1ms);
    }
  }
}

std::vector<SteadyClock::time_point> Robot::UntilSafe(Duration pause) const {
  std::vector<SteadyClock::time_point> safe(driver == Driver::kPlanner ? 1 : bases.size());
  const auto limit = SteadyClock::now() + 10s;
  for (std::size_t left = safe.size(); left > 0;) {
    if (SteadyClock::now() > limit) Fail("the robot moves on");
    for (std::size_t i = 0; i < safe.size(); ++i) {
      if (safe[i] != SteadyClock::time_point() || bases[i]->speed.Get() != 0) continue;
      safe[i] = SteadyClock::now();
      --left;
    }
    if (pause > Duration{} && left > 0) std::this_thread::sleep_for(pause);
  }
  return safe;
}

}  // namespace runnel::bench
