#include "plugins/structure/reload.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/plugins/structure/editor_fixture.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;

/// A folder with the plugin in one of its versions, and an application that runs it.
class ReloadTest : public ::testing::Test {
 protected:
  ReloadTest() { plugins.AddSearchFolder(folder_.path()); }
  ~ReloadTest() override { scheduler.Stop(); }

  /// What a linker does when it builds the library anew: another file in the place of the old one, which
  /// lives on for those who have it mapped.
  void Build(const std::string& version) {
    fs::copy_file(fs::path(RUNNEL_TEST_PLUGINS) / ("counting_" + version + ".so"), folder_ / "new");
    fs::rename(folder_ / "new", folder_ / "counting.so");
  }
  void Start() {
    Build("1");
    const auto loaded = plugins.Load("counting");
    ASSERT_TRUE(loaded) << loaded.error().ToString();
    CreateThread(runtime, "main", {.period = 10ms});
    ASSERT_TRUE(runtime.MakeReady(runtime.root()));
    const auto outcome = editor.Apply({CreateGroup{"/app"}, CreateModule{"/app/a", "counting/counting"},
                                       CreateModule{"/app/b", "counting/counting"}});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  std::string Refusal(const std::string& version) {
    Build(version);
    const auto outcome = ReloadPlugin(plugins, editor, runtime, "counting");
    EXPECT_FALSE(outcome);
    return outcome.diagnostics.ToString();
  }
  void Steps(int count) { scheduler.RunUntil(runtime.clock().Now() + count * 10ms); }
  /// What the module has published last.
  int Value(const std::string& module, const std::string& output = "out") {
    int value = -1;
    const std::lock_guard lock(runtime.structure_mutex());
    auto& port = dynamic_cast<Port&>(**runtime.root().Find(module + "/output/" + output));
    // The first member, in all versions.
    port.VisitLatest([&](const void* at, Time) { value = *static_cast<const int*>(at); });
    return value;
  }

  test::TemporaryFolder folder_;
  PluginManager plugins;
  Runtime runtime;
  Scheduler scheduler{runtime, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  StructureEditor editor{runtime, plugins.modules(), &scheduler};
};

TEST_F(ReloadTest, TheApplicationGoesOnWithTheNewCodeAndTheOldState) {
  Start();
  Steps(3);
  EXPECT_EQ(Value("/app/a"), 3);
  Build("2");
  const auto outcome = ReloadPlugin(plugins, editor, runtime, "counting");
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_EQ(Value("/app/a"), 3) << "the last value stays until the next comes";
  Steps(2);
  EXPECT_EQ(Value("/app/a"), 23);
  EXPECT_EQ(Value("/app/b"), 23);
  Build("1");
  ASSERT_TRUE(ReloadPlugin(plugins, editor, runtime, "counting"));
  Steps(1);
  EXPECT_EQ(Value("/app/a"), 24);
}

TEST_F(ReloadTest, WhatIsRefusedLeavesTheOldCodeRunning) {
  Start();
  EXPECT_THAT(Refusal("3"), HasSubstr("a library knows the type 'test::Tally' otherwise"));
  EXPECT_THAT(Refusal("3"), HasSubstr("its values have 16 bytes there, and 4 elsewhere"));
  EXPECT_THAT(Refusal("4"), HasSubstr("its description is another one there"));
  const std::string throwing = Refusal("5");
  EXPECT_THAT(throwing, HasSubstr("cannot register"));
  EXPECT_THAT(throwing, HasSubstr((folder_ / "counting.so").string())) << "not that of a copy";
  EXPECT_THAT(Refusal("6"), HasSubstr("no module type 'counting/counting'"));
  EXPECT_THAT(Refusal("6"), HasSubstr("there is 'counting/renamed'"));
  std::ofstream(folder_ / "new") << "This is text.";
  fs::rename(folder_ / "new", folder_ / "counting.so");
  EXPECT_THAT(ReloadPlugin(plugins, editor, runtime, "counting").diagnostics.ToString(), HasSubstr("counting.so"));
  EXPECT_THAT(ReloadPlugin(plugins, editor, runtime, "conting").diagnostics.ToString(),
              HasSubstr("did you mean 'counting'?"));
  Steps(2);
  EXPECT_EQ(Value("/app/a"), 2);
  ASSERT_TRUE(editor.Apply({CreateModule{"/app/c", "counting/counting"}}));
  EXPECT_EQ(plugins.modules().Find("counting/renamed"), nullptr);
}

TEST_F(ReloadTest, AListThatIsKeptGoesOverWithItsElements) {
  Start();
  Steps(100);
  Build("2");
  const auto outcome = ReloadPlugin(plugins, editor, runtime, "counting");
  ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  EXPECT_THAT(outcome.diagnostics.warnings(), IsEmpty());
  Steps(1);
  EXPECT_EQ(Value("/app/a", "marks"), 101);
  EXPECT_EQ(Value("/app/a", "sum_of_marks"), 101 * 102 * 203 / 6);
}

TEST_F(ReloadTest, AStateWhoseElementsHaveGotAFieldIsRefused) {
  Start();
  Steps(100);
  const std::string refusal = Refusal("7");
  EXPECT_THAT(refusal, HasSubstr("/app/a: the kept state 'std::vector<runnel::test::Mark"));
  EXPECT_THAT(refusal, HasSubstr("a library knows the type 'test::Mark' otherwise (its values have 12 bytes "
                                 "there, and 8 elsewhere"));
  Steps(1);
  EXPECT_EQ(Value("/app/a", "marks"), 101) << "the old code runs on";
  ASSERT_TRUE(editor.Apply({DeleteElement{"/app/a"}, DeleteElement{"/app/b"}}));
  EXPECT_TRUE(ReloadPlugin(plugins, editor, runtime, "counting")) << "nobody has such a state";
}

TEST_F(ReloadTest, AStateWithoutADescriptionIsRefused) {
  Start();
  Steps(3);
  EXPECT_THAT(Refusal("8"), HasSubstr("cannot be handed over to another library: its type has no "
                                      "description; write a Describe("));
  Steps(1);
  EXPECT_EQ(Value("/app/a", "marks"), 4);
}

TEST_F(ReloadTest, NoCopyOfTheLibraryIsLeftBehind) {
  // Others make copies, too, where all are made.
  const TemporaryFolder copies;
  const fs::path usual = fs::temp_directory_path();
  setenv("TMPDIR", copies.path().c_str(), 1);
  Start();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(ReloadPlugin(plugins, editor, runtime, "counting"));
  EXPECT_TRUE(fs::is_empty(copies.path()));
  setenv("TMPDIR", usual.c_str(), 1);
}

}  // namespace
}  // namespace runnel::test
