// What of a file changes when its application has changed, and what does not.

#include "plugins/application_files/saving/application_saver.h"

#include <functional>
#include <mutex>
#include <thread>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/proxy_port.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/scheduling/thread_container.h"
#include "tests/plugins/application_files/saving/loaded_file.h"

namespace runnel::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ApplicationSaver : public LoadedFile {};

TEST_F(ApplicationSaver, WritesTheSameBytesIfNothingHasChanged) {
  Load();
  EXPECT_EQ(Text(), kFile);
}

TEST_F(ApplicationSaver, LeavesValuesOfTheCommandLineToIt) {
  ASSERT_TRUE(shop_.configuration.AddArgument("count=7"));
  Load();
  EXPECT_EQ(Get<Source>("/demo/source").count.Get(), 7);
  EXPECT_EQ(Text(), kFile);
  ASSERT_TRUE(Get<Source>("/demo/source").count.Set(8));
  EXPECT_EQ(Text(), With("value=\"4\"", "value=\"8\""));
}

TEST_F(ApplicationSaver, RewritesAChangedValueWithinItsQuotes) {
  Load();
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  EXPECT_EQ(Text(), With("'2.50'", "'3.5'"));
}

TEST_F(ApplicationSaver, WritesAParameterUnderItsNameOfToday) {
  Load(With("'gain'", "'boost'"));
  EXPECT_EQ(Text(), With("'gain'", "'gain'"));
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  EXPECT_EQ(Text(), With("'2.50'", "'3.5'")) << "once";
}

TEST_F(ApplicationSaver, AddsAValueThatWasNotThere) {
  Load(With("    <parameter name='gain'   value='2.50'/>\n", ""));
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  EXPECT_EQ(Text(), With("command_line=\"count\"/>\n",
                         "command_line=\"count\"/>\n    <parameter name=\"gain\" "
                         "value=\"3.5\"/>\n",
                         With("    <parameter name='gain'   value='2.50'/>\n", "")));
}

TEST_F(ApplicationSaver, TakesOneNameOutOfAList) {
  Load();
  ASSERT_TRUE(Port::Disconnect(Get<Port>("/demo/inner/in"), Get<Port>("/demo/inner/sink/input/second")));
  EXPECT_EQ(Text(),
            With("<port name=\"in\" direction=\"input\"/>", "<port name=\"in\" direction=\"input\" type=\"double\"/>",
                 With("\"filter/value  sink/second\"", "\"filter/value\"")));
}

TEST_F(ApplicationSaver, RefusesWhatWouldNotLoad) {
  Load();
  ASSERT_TRUE(Port::Disconnect(Get<Port>("/demo/inner/in"), Get<Port>("/demo/inner/filter/input/value")));
  const auto text = testing::ApplicationText(*application_, shop_.tools(), folder_.path());
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().path, "/demo/inner/filter/input/value");
  EXPECT_THAT(text.error().message, HasSubstr("would not load"));
}

TEST_F(ApplicationSaver, CutsAConnectionWithItsLine) {
  Load();
  ASSERT_TRUE(
      Port::Disconnect(Get<Port>("/demo/inner/filter/output/value"), Get<Port>("/demo/inner/sink/input/value")));
  EXPECT_EQ(Text(), With("      <connect from=\"filter/value\" to=\"sink/value\" queue=\"3\" "
                         "on_full=\"refuse\"/>\n",
                         ""));
}

TEST_F(ApplicationSaver, RewritesTheQueueOfAConnection) {
  Load();
  auto& from = Get<Port>("/demo/inner/filter/output/value");
  auto& to = Get<Port>("/demo/inner/sink/input/value");
  ASSERT_TRUE(Port::Disconnect(from, to));
  ASSERT_TRUE(Port::Connect(from, to, {.queue = 5}));
  EXPECT_EQ(Text(), With("queue=\"3\" on_full=\"refuse\"", "queue=\"5\""));
}

TEST_F(ApplicationSaver, KeepsConnectionsThatLeadOutAsLongAsTheyAreThere) {
  shop_.Add<Optional>("test/optional");
  ASSERT_NE(shop_.Build(R"(<application name="other"><module name="a" type="test/source"/>
    <module name="b" type="test/sink"/></application>)"),
            nullptr);
  const std::string text = R"(<application name="demo">
  <module name="m" type="test/optional"/>
  <connect from="/other/a/value" to="m/value"/>
  <connect from="m/output/value" to="../other/b/value /other/b/second"/>
</application>)";
  Load(text);
  EXPECT_EQ(Text(), text);
  ASSERT_TRUE(Port::Disconnect(shop_.Get<Port>("/demo/m/output/value"), shop_.Get<Port>("/other/b/input/value")));
  EXPECT_EQ(Text(), With("../other/b/value /other/b/second", "/other/b/second", text));
}

TEST_F(ApplicationSaver, CutsWhatADeletedModuleLeavesBehind) {
  Load();
  Delete("/demo/inner/filter");
  const std::string text = Text();
  EXPECT_THAT(text, Not(HasSubstr("test/filter")));
  EXPECT_THAT(text, Not(HasSubstr("filter/value")));
  EXPECT_THAT(text, Not(HasSubstr("on_fault")));
  EXPECT_THAT(text, HasSubstr("      <!-- of the filter -->\n"));
  EXPECT_THAT(text, HasSubstr("<connect from=\"in\" to=\"sink/second\"/>"));
}

TEST_F(ApplicationSaver, AppendsWhatIsNewToItsGroup) {
  Load();
  Create("test/sink", "/demo/inner", "log");
  ASSERT_TRUE(Port::Connect(Get<Port>("/demo/inner/filter/output/value"), Get<Port>("/demo/inner/log/input/value"),
                            {.queue = 2}));
  ASSERT_TRUE(Port::Connect(Get<Port>("/demo/source/output/label"), Get<Port>("/demo/inner/log/input/label")));
  std::string expected = With("  </group>\n",
                              "      <module name=\"log\" type=\"test/sink\"/>\n"
                              "      <connect from=\"filter/value\" to=\"log/value\" queue=\"2\"/>\n  </group>\n");
  expected = With("</application>",
                  "  <connect from=\"source/label\" to=\"inner/log/label\"/>\n"
                  "</application>",
                  expected);
  EXPECT_EQ(Text(), expected);
}

TEST_F(ApplicationSaver, TellsAnInputAndAnOutputOfOneNameApart) {
  Load();
  Create("test/filter", "/demo", "second");
  ASSERT_TRUE(Port::Connect(Get<Port>("/demo/source/output/value"), Get<Port>("/demo/second/input/value")));
  EXPECT_THAT(Text(), HasSubstr("<connect from=\"source/value\" to=\"second/value\"/>"));
}

TEST_F(ApplicationSaver, RewritesTheTypeOfAReplacedModule) {
  Load();
  Delete("/demo/inner/sink");
  Create("test/source", "/demo/inner", "sink");
  ASSERT_TRUE(Get<Source>("/demo/inner/sink").gain.Set(4));
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("      <module name=\"sink\" type=\"test/source\">\n"
                              "        <parameter name=\"gain\" value=\"4\"/>\n"
                              "      </module>\n"));
}

TEST_F(ApplicationSaver, WritesANewGroupWithAllThatIsInIt) {
  Load();
  auto& group = shop_.runtime.Create<Group>(Get<FrameworkElement>("/demo"), "outer");
  auto& port =
      shop_.runtime.Create<ProxyPort>(group, "values", Port::Direction::kOutput, TypeOf<double>(), "all \"values\"");
  Create("test/source", "/demo/outer", "a");
  ASSERT_TRUE(Port::Connect(Get<Port>("/demo/outer/a/output/value"), port));
  EXPECT_EQ(Text(), With("</application>",
                         "  <group name=\"outer\">\n"
                         "    <port name=\"values\" direction=\"output\" type=\"double\" "
                         "description=\"all &quot;values&quot;\"/>\n\n"
                         "    <module name=\"a\" type=\"test/source\"/>\n\n"
                         "    <connect from=\"a/value\" to=\"values\"/>\n"
                         "  </group>\n</application>"));
}

TEST_F(ApplicationSaver, FollowsModulesToOtherThreads) {
  Load();
  AssignThread(Get<FrameworkElement>("/demo/source"), Get<ThreadContainer>("/demo/threads/fast"));
  AssignThread(Get<FrameworkElement>("/demo/inner"), Get<ThreadContainer>("/demo/threads/slow"));
  EXPECT_EQ(Text(), With("<group name=\"inner\">", "<group name=\"inner\" thread=\"slow\">",
                         With("thread=\"slow\"", "thread=\"fast\"")));
  Delete("/demo/threads/slow");
  EXPECT_EQ(Text(),
            With("  <thread name=\"slow\" period=\"0.05 s\"/>\n", "", With("thread=\"slow\"", "thread=\"fast\"")));
}

TEST_F(ApplicationSaver, WritesNewThreads) {
  Load();
  auto& thread = shop_.runtime.Create<ThreadContainer>(
      Get<FrameworkElement>("/demo/threads"), "new",
      ThreadOptions{.activation = ThreadOptions::Activation::kTrigger, .priority = 4});
  AssignThread(Get<FrameworkElement>("/demo/source"), thread);
  EXPECT_EQ(Text(), With("</application>",
                         "  <thread name=\"new\" activation=\"trigger\" priority=\"4\"/>\n"
                         "</application>",
                         With("thread=\"slow\"", "thread=\"new\"")));
}

TEST_F(ApplicationSaver, WritesAWholeFileOfWhatCodeHasBuilt) {
  auto& application = shop_.runtime.Create<Group>(shop_.runtime.root(), "made");
  application_ = &application;
  Create("test/source", "/made", "source");
  auto& inner = shop_.runtime.Create<Group>(application, "inner");
  Create("test/sink", "/made/inner", "sink");
  ASSERT_TRUE(Get<Source>("/made/source").text.SetFromText("a < b"));
  ASSERT_TRUE(Port::Connect(Get<Port>("/made/source/output/value"), Get<Port>("/made/inner/sink/input/value")));
  ASSERT_TRUE(Port::Connect(Get<Port>("/made/source/output/value"), Get<Port>("/made/inner/sink/input/second")));
  AssignThread(inner, CreateThread(shop_.runtime, "own", {.period = std::chrono::seconds(1)}));
  EXPECT_EQ(Text(), R"(<application name="made">
  <thread name="own" period="1s"/>

  <module name="source" type="test/source">
    <parameter name="text" value="a &lt; b"/>
  </module>

  <group name="inner" thread="own">
    <module name="sink" type="test/sink"/>
  </group>

  <connect from="source/value" to="inner/sink/value inner/sink/second"/>
</application>
)");
}

TEST_F(ApplicationSaver, RefusesAModuleThatNoFileCanName) {
  Load();
  shop_.runtime.Create<Source>(Get<FrameworkElement>("/demo"), "by_code");
  const auto text = testing::ApplicationText(*application_, shop_.tools(), folder_.path());
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().path, "/demo/by_code");
  EXPECT_THAT(text.error().message, HasSubstr("no file can name"));
}

TEST_F(ApplicationSaver, WritesNamesOfFilesSeenFromTheFolderOfTheText) {
  const std::string text = R"(<application name="demo">
  <module name="source" type="test/source">
    <parameter name="file" value="data/world.xml"/>
  </module>
</application>
)";
  Load(text);
  EXPECT_EQ(Text(), text);
  EXPECT_THAT(shop_.Text(*application_, folder_ / "below"), HasSubstr("value=\"../data/world.xml\""));
  Create("test/source", "/demo", "late");
  const auto other = std::filesystem::relative(folder_ / "other.xml");
  ASSERT_TRUE(Get<Source>("/demo/late").file.SetFromText(other.string()));
  EXPECT_THAT(Text(), HasSubstr("value=\"other.xml\""));
}

TEST_F(ApplicationSaver, SavesToTheFileItCameFromAgainAndAgain) {
  Load();
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  EXPECT_EQ(ReadAll(file_), With("'2.50'", "'3.5'"));
  Delete("/demo/inner");
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  EXPECT_THAT(ReadAll(file_), AllOf(HasSubstr("'3.5'"), Not(HasSubstr("inner"))));
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(2.5));
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  EXPECT_THAT(ReadAll(file_), HasSubstr("'2.5'"));
}

/// Looks when it is made whether the structure of the other runtime can be changed meanwhile.
struct Prober final : Module {
  explicit Prober(const Placement& placement) : Module(placement) {
    if (other == nullptr || &runtime() == other) return;
    ++looks;
    std::thread([] {
      const std::unique_lock lock(other->structure_mutex(), std::try_to_lock);
      if (lock) ++free;
    }).join();
  }
  void Update() override {}
  static inline Runtime* other = nullptr;
  static inline int looks = 0;
  static inline int free = 0;
};

// Constructors may take long, and who watches whether all is well needs the lock.
TEST_F(ApplicationSaver, BuildsWithoutTheStructureLock) {
  shop_.Add<Prober>("test/prober");
  Load();
  Create("test/prober", "/demo", "prober");
  Prober::other = &shop_.runtime;
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  Prober::other = nullptr;
  EXPECT_EQ(Prober::looks, 1);
  EXPECT_EQ(Prober::free, 1);
}

TEST_F(ApplicationSaver, DoesNotOverwriteWhatSomebodyElseHasChanged) {
  Load();
  WriteAll(file_, With("demo", "mine"));
  ASSERT_TRUE(Get<Source>("/demo/source").gain.Set(3.5));
  const auto saved = SaveApplication(application_->runtime(), *application_, shop_.tools());
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().message, HasSubstr("has been changed"));
  EXPECT_EQ(ReadAll(file_), With("demo", "mine"));
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools(), folder_ / "copy.xml"));
  EXPECT_EQ(ReadAll(folder_ / "copy.xml"), With("'2.50'", "'3.5'"));
}

TEST_F(ApplicationSaver, WritesNothingWhereAnInstallationHasItsFiles) {
  Load();
  const auto folder = folder_ / "share/runnel/xml/apps";
  std::filesystem::create_directories(folder);
  const auto saved = SaveApplication(application_->runtime(), *application_, shop_.tools(),
                                     folder_ / "share/other/../runnel/xml/apps/a.xml");
  ASSERT_FALSE(saved);
  EXPECT_THAT(saved.error().message, HasSubstr("comes with Runnel"));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(ApplicationSaver, FirstFileOfWhatCodeHasBuiltIsItsFile) {
  application_ = &shop_.runtime.Create<Group>(shop_.runtime.root(), "made");
  const auto without = SaveApplication(application_->runtime(), *application_, shop_.tools());
  ASSERT_FALSE(without);
  EXPECT_EQ(without.error().path, "/made");
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools(), file_));
  Create("test/sink", "/made", "sink");
  ASSERT_TRUE(SaveApplication(application_->runtime(), *application_, shop_.tools()));
  EXPECT_EQ(ReadAll(file_),
            "<application name=\"made\">\n  <module name=\"sink\" type=\"test/sink\"/>\n"
            "</application>\n");
}

}  // namespace
}  // namespace runnel::testing
