// Modules in Python are made, replaced and deleted or not, wherever memory of C++ runs out. What they throw themselves:
// test_faults.py.

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "tests/support/faulty_operation.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

constexpr const char* kModules = R"(import runnel


class Ticker(runnel.Module):
    period = 0.02
    out = runnel.Output("int64")
    goal = runnel.Input("double")
    step = runnel.Parameter(1)
    name = runnel.Parameter("a text that is too long to be within itself")
    count = 0

    @runnel.service
    def ask(self, number: int) -> int:
        return number + 1

    def update(self):
        self.count += self.step
        self.out.publish(self.count)


class Other(Ticker):
    further = runnel.Output("double")
)";

constexpr const char* kFile = R"(<application name="robot">
  <load plugin="python"/>
  <clock type="simulated" speed="0"/> <thread name="control" period="10ms"/>
  <module name="ticker" type="python/tickers.Ticker"/>
</application>
)";

/// An application with a module in Python, from the same files each time.
struct PythonRobot {
  PythonRobot() {
    (void)setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
    (void)setenv("PATH", std::filesystem::path(RUNNEL_TEST_PYTHON).parent_path().c_str(), 1);
    std::ofstream(folder / "tickers.py") << kModules;
    std::ofstream(folder / "robot.xml") << kFile;
  }

  std::unique_ptr<Application> Make() const {
    auto loaded = Application::Load(folder / "robot.xml", {.plugin_folders = {RUNNEL_TEST_PLUGIN_FOLDER}});
    EXPECT_TRUE(loaded) << loaded.diagnostics().ToString();
    if (!loaded) return nullptr;
    EXPECT_TRUE(loaded->RunFor(std::chrono::milliseconds(100)));
    return loaded.Take();
  }
  static std::int64_t CountOf(Application& application, const std::string& module) {
    const auto count = application.Read<std::int64_t>(module + "/out");
    EXPECT_TRUE(count) << count.error().ToString();
    return count ? count->value_or(0) : 0;
  }
  /// `module` goes on afterwards; "": nothing is left to.
  FaultyOperation Changes(ChangeSet changes, const std::string& module) const {
    return {.make = [this] { return Make(); },
            .carry_out = [changes](Application& application) { return application.Apply(changes).ToResult(); },
            .prove =
                [module](Application& application) {
                  if (module.empty()) return;
                  const std::int64_t before = CountOf(application, module);
                  EXPECT_TRUE(application.RunFor(std::chrono::milliseconds(100)));
                  EXPECT_GT(CountOf(application, module), before + 2);
                }};
  }

  TemporaryFolder folder;
};

// With a thread of its own.
TEST(PythonFaults, AModuleIsMadeOrNot) {
  const PythonRobot robot;
  const ChangeSet make{CreateModule{"/robot/new", "python/tickers.Other", {{"step", "2"}}}};
  EXPECT_GT(Endure(robot.Changes(make, "/robot/new")), 100u);
}
TEST(PythonFaults, AModuleIsReplacedOrNot) {
  const PythonRobot robot;
  const ChangeSet replace{ReplaceModule{"/robot/ticker", "python/tickers.Other", {{"step", "2"}}}};
  EXPECT_GT(Endure(robot.Changes(replace, "/robot/ticker")), 100u);
}
TEST(PythonFaults, AModuleIsDeletedOrNot) {
  const PythonRobot robot;
  EXPECT_GT(Endure(robot.Changes({DeleteElement{"/robot/ticker"}}, "")), 10u);
}

}  // namespace
}  // namespace runnel::test
