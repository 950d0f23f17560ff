// Values from outside, of a configuration, a terminal or a hand, are taken or not, and files written or not, wherever memory
// runs out.

#include <fstream>
#include <memory>
#include <new>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "core/module/module.h"
#include "core/port/input.h"
#include "plugins/application/application.h"
#include "plugins/parameters/configuration.h"
#include "plugins/parameters/parameter.h"
#include "tests/support/faulty_operation.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;

class ConfiguredMover final : public Module {
 public:
  using Module::Module;
  Parameter<double> speed{this, "speed", {.default_value = 0.5, .bounds = {0.0, 2.0}, .unit = "m/s"}};
  Parameter<std::string> name{this, "name", {.default_value = "nobody"}};
  StaticParameter<std::string> label{this, "label", {.default_value = "none"}};
  Input<double> goal{this, "goal", {.limits = {.default_value = 0.0}}};
  double has_seen = 0;

 private:
  void Update() override { has_seen = goal.Get() + speed.Get(); }
};

constexpr const char* kFile = R"(<application name="robot">
  <clock type="simulated" speed="0"/> <thread name="main" period="10ms"/>
  <module name="mover" type="test/mover">
    <parameter name="speed" config="/motion/a_speed_with_a_long_name"/>
    <parameter name="name" config="/a_name_that_is_too_long_to_fit/into_a_string"/>
  </module>
  <module name="other" type="test/mover">
    <parameter name="speed" config="/motion/others_speed"/>
  </module>
</application>
)";
constexpr const char* kConfiguration = R"(<configuration>
  <section name="motion"><value name="a_speed_with_a_long_name">1</value></section>
</configuration>
)";
constexpr const char* kMore = R"(<configuration>
  <section name="motion">
    <value name="a_speed_with_a_long_name">1.5</value> <value name="others_speed">1.25</value>
  </section>
</configuration>
)";

std::string ContentsOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// An application with two configuration files, written anew each time.
struct ConfiguredRobot {
  ConfiguredRobot() { std::ofstream(folder / "robot.xml") << kFile; }

  std::unique_ptr<Application> Make() const {
    for (const auto& each : fs::directory_iterator(folder.path())) {
      if (each.path().filename() != "robot.xml") fs::remove(each.path());
    }
    std::ofstream(folder / "first.xml") << kConfiguration;
    std::ofstream(folder / "more.xml") << kMore;
    auto loaded = Application::LoadFrom(
        [&](const BuildTools& tools) {
          (void)tools.plugins.modules().Add({"test/mover", "", "test", [](const Placement& placement) {
                                               return std::unique_ptr<FrameworkElement>(
                                                   std::make_unique<ConfiguredMover>(placement));
                                             }});
          return BuildApplication(folder / "robot.xml", tools, BuildMode::kConstruct);
        },
        {.configurations = {folder / "first.xml", folder / "more.xml"}});
    EXPECT_TRUE(loaded) << loaded.diagnostics().ToString();
    return loaded ? loaded.Take() : nullptr;
  }
  /// All files but what has been kept of those that were replaced.
  [[nodiscard]] std::string Files() const {
    std::set<fs::path> files;
    for (const auto& each : fs::directory_iterator(folder.path())) files.insert(each.path());
    std::string all;
    for (const fs::path& each : files) {
      if (!each.string().ends_with('~')) all += each.filename().string() + "\n" + ContentsOf(each);
    }
    return all;
  }
  FaultyOperation Does(std::function<Result<void>(Application&)> what) const {
    return {.make = [this] { return Make(); },
            .carry_out = std::move(what),
            .prove = [](Application& application) { EXPECT_TRUE(application.RunCycles(2)); },
            .look = [this](Application&) { return Files(); }};
  }

  TemporaryFolder folder;
};

const std::string kLongText(100, 'x');

Result<void> Told(const Result<std::string>& done) {
  if (!done) return done.error();
  return {};
}

TEST(OutsideFaults, AParameterIsSetOrNot) {
  const ConfiguredRobot robot;
  const auto set = [](Application& application) { return application.Set("/mover/name", kLongText); };
  EXPECT_GT(Endure(robot.Does(set)), 20u);
}
TEST(OutsideFaults, AModuleIsMadeAnewForAStaticParameterOrNot) {
  const ConfiguredRobot robot;
  const auto set = [](Application& application) { return application.Set("/mover/label", kLongText); };
  EXPECT_GT(Endure(robot.Does(set)), 100u);
}
TEST(OutsideFaults, AValueIsSetByHandOrNot) {
  const ConfiguredRobot robot;
  const auto set = [](Application& application) { return application.PublishByHand("/mover/goal", "0.25"); };
  EXPECT_GT(Endure(robot.Does(set)), 5u);
}
TEST(OutsideFaults, AValueByHandIsReleasedOrNot) {
  const ConfiguredRobot robot;
  FaultyOperation released = robot.Does([](Application& application) { return application.Release("/mover/goal"); });
  released.make = [&] {
    auto application = robot.Make();
    EXPECT_TRUE(application->PublishByHand("/mover/goal", "0.25"));
    return application;
  };
  EXPECT_GT(Endure(released), 2u);
}

// One of them may have been written: each is whole, the error says which could not be, and the next try writes the rest.
TEST(OutsideFaults, ValuesAreSavedToTheConfigurationAndTheApplicationKnowsIt) {
  const ConfiguredRobot robot;
  bool has_struck = true;
  std::size_t points = 0;
  for (std::size_t nth = 1; has_struck && !HasFailure(); nth += 1 + nth / 50, ++points) {
    SCOPED_TRACE(nth);
    const auto application = robot.Make();
    ASSERT_TRUE(application->Set("/mover/speed", "0.75"));
    ASSERT_TRUE(application->Set("/mover/name", kLongText));
    Result<void> saved;
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      saved = Told(application->SaveConfiguration());
    } catch (const std::bad_alloc&) {
      saved = Error{.message = "out of memory"};
    }
    injection.End();
    has_struck = injection.has_struck();
    EXPECT_TRUE(saved || has_struck);
    const std::string more = ContentsOf(robot.folder / "more.xml");
    const bool is_written = more.find("0.75") != std::string::npos;
    EXPECT_TRUE(is_written || more == kMore);
    EXPECT_TRUE(is_written || !saved);
    EXPECT_EQ(ContentsOf(robot.folder / "first.xml"), kConfiguration);
    ASSERT_TRUE(application->Set("/other/speed", "0.125"));
    const auto again = application->SaveConfiguration();
    EXPECT_TRUE(again) << again.error().ToString();
    const std::string then = ContentsOf(robot.folder / "more.xml");
    for (const std::string& each : {std::string("0.75"), std::string("0.125"), kLongText}) {
      EXPECT_NE(then.find(each), std::string::npos) << each << " is not in " << then;
    }
  }
  EXPECT_GT(points, 50u);
}
TEST(OutsideFaults, ANewConfigurationIsWrittenOrNot) {
  const ConfiguredRobot robot;
  const auto save = [&](Application& application) {
    return Told(application.SaveConfiguration(robot.folder / "new.xml"));
  };
  FaultyOperation saved = robot.Does(save);
  EXPECT_GT(Endure(saved), 20u);
}

TEST(OutsideFaults, AConfigurationFileIsLoadedOrNot) {
  const ConfiguredRobot robot;
  (void)robot.Make();
  const auto contents = [](Configuration& configuration) {
    std::string all;
    for (const std::string& path : configuration.EntryPaths()) {
      all += path + " " + configuration.FindEntry(path)->text + "\n";
    }
    for (const auto& file : configuration.files()) all += file.name + "\n";
    return all;
  };
  std::unique_ptr<Configuration> configuration;
  const auto load = [&](const char* name) {
    Diagnostics diagnostics;
    try {
      configuration->Load(robot.folder / name, diagnostics);
    } catch (const std::bad_alloc&) {
      return false;
    }
    return diagnostics.ok();
  };
  std::string before;
  std::string after;
  const auto make = [&] {
    configuration = std::make_unique<Configuration>();
    ASSERT_TRUE(load("first.xml"));
    before = contents(*configuration);
  };
  make();
  ASSERT_TRUE(load("more.xml"));
  after = contents(*configuration);
  make();
  bool is_loaded = false;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { is_loaded = load("more.xml"); },
      [&](bool has_struck) {
        ASSERT_TRUE(is_loaded || has_struck);
        ASSERT_EQ(contents(*configuration), is_loaded ? after : before);
        if (!is_loaded) {
          ASSERT_TRUE(load("more.xml"));
          ASSERT_EQ(contents(*configuration), after);
        }
        make();
      });
  EXPECT_GT(points, 20u);
}

TEST(OutsideFaults, AnArgumentIsTakenOrNot) {
  auto configuration = std::make_unique<Configuration>();
  const std::string argument = "an_argument_with_a_long_name=" + kLongText;
  bool is_taken = false;
  const auto add = [&] {
    is_taken = false;
    try {
      is_taken = configuration->AddArgument(argument).has_value();
    } catch (const std::bad_alloc&) {
    }
  };
  const std::size_t points = AtEachPoint(InjectedFault::kAllocation, add, [&](bool has_struck) {
    ASSERT_NE(is_taken, has_struck);
    if (has_struck) {
      ASSERT_EQ(configuration->FindArgument("an_argument_with_a_long_name"), nullptr);
      add();
    }
    ASSERT_TRUE(is_taken);
    ASSERT_EQ(configuration->FindArgument("an_argument_with_a_long_name")->text, kLongText);
    configuration = std::make_unique<Configuration>();
  });
  EXPECT_GT(points, 2u);
}

}  // namespace
}  // namespace runnel::test
