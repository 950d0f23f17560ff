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
  explicit Slow(const Placement& placement) : Module(placement) { std::this_thread::sleep_for(5s); }

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
                if (create != nullptr && create->type.starts_with("elsewhere/")) std::this_thread::sleep_for(5s);
              },
          .save = [](const std::string&) -> Result<std::string> {
            std::this_thread::sleep_for(5s);
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

void Planner::PublishPicture() {
  auto loan = picture.Loan();
  loan->assign(1'000'000, 7);
  picture.Publish(std::move(loan));
}

Robot::Robot() {
  Register<Base>(modules, "bench/base");
  Register<Slow>(modules, "bench/slow");
  for (int i = 0; i < kBases; ++i) {
    bases.push_back(&runtime.Create<Base>(runtime.root(), "base" + std::to_string(i)));
  }
  planner = &runtime.Create<Planner>(runtime.root(), "planner");
  if (!Port::Connect(planner->speed, bases.front()->speed)) Fail("cannot connect");
  if (!runtime.MakeReady(runtime.root())) Fail("cannot begin");
  service = std::make_unique<CommandService>(
      ServedApplication{runtime, modules, editor, log, SlowHooks(), &history, &scheduler.pace(), &scheduler});
  std::string name = (std::filesystem::temp_directory_path() / "bench_stop_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) Fail("cannot make " + name);
  folder = name;
  control = Started(ControlServer::Start(*service, {.application = "bench", .folder = folder}));
  inspector = std::make_unique<Inspector>(*service, scheduler, InspectorOptions{.application = "bench"});
  web = Started(WebServer::Start({.port = 0}, InspectorPage(), {inspector->Protocol()}));
}

Robot::~Robot() { std::filesystem::remove_all(folder); }

void Robot::UntilRead(bool is_moving, Duration pause) const {
  const auto limit = SteadyClock::now() + 10s;
  while ((bases.front()->speed.Get() != 0) != is_moving) {
    if (SteadyClock::now() > limit) Fail(is_moving ? "the robot does not move" : "the robot moves on");
    if (pause > Duration{}) std::this_thread::sleep_for(pause);
  }
}

}  // namespace runnel::bench
