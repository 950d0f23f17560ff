// A plugin is loaded, and loaded anew, or everything is as it was, wherever memory runs out.

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "plugins/structure/reload.h"
#include "plugins/testing/fault_injection.h"
#include "tests/plugins/structure/editor_fixture.h"
#include "tests/support/temporary_folder.h"

extern "C" void InjectionPointForPlugins() { runnel::test::InjectionPoint(); }

namespace runnel::test {
namespace {

namespace fs = std::filesystem;

const std::string kPlugin = "counting_by_a_long_name";  // not within the text itself

/// An application with two modules of a plugin, the library of which has been built anew meanwhile: from now on it
/// counts by ten.
class ReloadWorld {
 public:
  explicit ReloadWorld(const std::string& version = "1", const std::string& next = "2") {
    Put(version);
    plugins.AddSearchFolder(folder_.path());
    Must(plugins.Load(kPlugin));
    CreateThread(runtime, "main", {.period = 10ms});
    Must(runtime.MakeReady(runtime.root()));
    Must(editor.Apply({CreateGroup{"/app"}, CreateModule{"/app/a", "counting/counting"},
                       CreateModule{"/app/b", "counting/counting"}}));
    Run();
    Put(next);
  }
  template <typename Outcome>
  static void Must(const Outcome& outcome) {
    if (!outcome) throw std::runtime_error("the world of the test cannot be made");
  }
  void Run() { Must(scheduler.RunUntil(runtime.clock().Now() + 20ms)); }
  int Value(const std::string& module) {
    int value = -1;
    const std::lock_guard lock(runtime.structure_mutex());
    auto& port = dynamic_cast<Port&>(**runtime.root().Find(module + "/output/out"));
    // The first member, in all versions.
    port.VisitLatest([&](const void* at, Time) { value = *static_cast<const int*>(at); });
    return value;
  }
  std::string Dump() {
    const std::lock_guard lock(runtime.structure_mutex());
    std::string text;
    runtime.root().Visit([&](FrameworkElement& each) {
      text += each.path() + " #" + std::to_string(each.id()) + " " + FindModuleType(each) + "\n";
    });
    for (const ModuleType* type : plugins.modules().All()) text += type->name + " of " + type->plugin + "\n";
    return text + std::to_string(plugins.loaded().size()) + " plugins";
  }

  PluginManager plugins;
  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  StructureEditor editor{runtime, plugins.modules(), &scheduler};

 private:
  void Put(const std::string& version) {
    fs::copy_file(fs::path(RUNNEL_TEST_PLUGINS) / ("counting_" + version + ".so"), folder_ / "new");
    fs::rename(folder_ / "new", folder_ / (kPlugin + ".so"));
  }
  TemporaryFolder folder_;
};

std::size_t EndureReload(InjectedFault fault, const std::string& version, const std::string& next) {
  auto world = std::make_unique<ReloadWorld>(version, next);
  std::string dump = world->Dump();
  ChangeOutcome outcome;
  return AtEachPoint(
      fault, [&] { outcome = ReloadPlugin(world->plugins, world->editor, world->runtime, kPlugin); },
      [&](bool has_struck) {
        if (!has_struck) {
          ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
        }
        const int before = world->Value("/app/a");
        if (!outcome) {
          ASSERT_EQ(world->Dump(), dump) << outcome.diagnostics.ToString();
        }
        world->Run();
        ASSERT_EQ(world->Value("/app/a"), before + (outcome ? 20 : 2)) << outcome.diagnostics.ToString();
        ASSERT_EQ(world->Value("/app/b"), world->Value("/app/a"));
        if (!outcome) return;
        world = std::make_unique<ReloadWorld>(version, next);
        dump = world->Dump();
      });
}

TEST(ReloadFaultsTest, APluginIsLoadedAnewOrNot) {
  EXPECT_GT(EndureReload(InjectedFault::kAllocation, "1", "2"), 100u);
}

// Registration, descriptions of types and states, constructors, preparation.
TEST(ReloadFaultsTest, APluginThatThrowsIsLoadedAnewOrNot) {
  EXPECT_GE(EndureReload(InjectedFault::kException, "9", "10"), 7u);
  EXPECT_GE(EndureReload(InjectedFault::kNumber, "9", "10"), 7u);
}

TEST(ReloadFaultsTest, APluginIsLoadedOrNot) {
  TemporaryFolder folder;
  fs::copy_file(fs::path(RUNNEL_TEST_PLUGINS) / "counting_1.so", folder / (kPlugin + ".so"));
  Result<void> loaded;
  std::unique_ptr<PluginManager> plugins;
  const auto make = [&] {
    plugins = std::make_unique<PluginManager>();
    plugins->AddSearchFolder(folder.path());
  };
  make();
  AtEachPoint(
      InjectedFault::kAllocation, [&] { loaded = plugins->Load(kPlugin); },
      [&](bool has_struck) {
        if (!has_struck) {
          ASSERT_TRUE(loaded) << loaded.error().ToString();
        }
        ASSERT_EQ(plugins->loaded().size(), loaded ? 1u : 0u);
        ASSERT_EQ(plugins->modules().All().size(), loaded ? 1u : 0u);
        if (loaded) make();
      });
}

}  // namespace
}  // namespace runnel::test
