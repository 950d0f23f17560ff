// A file that is saved while a rule is in force has what people have made, and not what the rule has made for the time
// being.

#include <gmock/gmock.h>

#include "plugins/application_tags/run_description.h"
#include "plugins/parameters/configuration_saver.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/saving/saving_workshop.h"

namespace runnel::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// In the place of a source: with another default, without some of its parameters, and with one of its own.
class Spare final : public Module {
 public:
  using Module::Module;
  Output<double> value{this, "value"};
  Output<std::string> label{this, "label"};
  Parameter<double> gain{this, "gain", {.default_value = 7}};
  Parameter<double> own{this, "own", {.default_value = 8}};

 private:
  void Update() override {}
};

constexpr const char* kFile = R"(<application name="demo">
  <module name="a" type="test/source"/>
  <module name="b" type="test/source">
    <parameter name="gain" value="3"/>
    <parameter name="count" value="5"/>
  </module>
  <module name="sink" type="test/sink"/>
  <module name="filter" type="test/filter"/>
  <module name="gauge" type="test/source" config="/gauge"/>
  <group name="both">
    <parameter name="gain" to="one/gain two/gain" value="4"/>
    <module name="one" type="test/source"/>
    <module name="two" type="test/source"/>
  </group>
  <connect from="a/value" to="sink/value" queue="5"/>
  <connect from="gauge/value" to="filter/value"/>
  <on_stale input="sink/value" after="30ms" fresh_after="20ms">
    <switch input="filter/value" from="gauge/value"/>
    <switch input="sink/value" from="a/value" to="b/value"/>
    <set parameter="gauge/gain" value="2"/>
    <set parameter="both/gain" value="1"/>
    <replace module="b" by="test/spare"/>
    <otherwise>
      <switch input="filter/value" to="gauge/value"/>
      <switch input="sink/value" from="b/value" to="a/value"/>
      <set parameter="gauge/gain" value="6"/>
    </otherwise>
  </on_stale>
</application>
)";

class SavedRules : public ::testing::Test {
 protected:
  SavedRules() {
    shop.Add<Spare>("test/spare");
    WriteAll(folder / "app.xml", kFile);
    application = shop.Load(folder / "app.xml");
    if (application == nullptr) throw std::runtime_error("the file does not load");
    scheduler.emplace(shop.runtime, SchedulerOptions{.clock = SchedulerOptions::ClockKind::kSimulated});
    editor.emplace(shop.runtime, shop.plugins.modules(), &*scheduler);
    supervisor.emplace(shop.runtime, *scheduler, [this](const ChangeSet& changes) -> Result<ChangeSet> {
      ChangeSet back;
      const ChangeOutcome outcome = editor->Apply(changes, {}, {}, &back);
      if (!outcome) return outcome.diagnostics.errors().front();
      return back;
    });
    EXPECT_TRUE(AddRules(*application, *scheduler, *supervisor));
    EXPECT_EQ(Text(), kFile);
    scheduler->RunUntil(Time(100ms));  // the source publishes nothing
    EXPECT_EQ(shop.Get<Spare>("/demo/b").gain.Get(), 3);
    EXPECT_EQ(GainOf("gauge"), 2);
    EXPECT_EQ(SourceOfSink(), "/demo/b/output/value");
    EXPECT_TRUE(shop.Get<Port>("/demo/filter/input/value").incoming().empty()) << "though its module requires it";
  }
  ~SavedRules() override {
    supervisor.reset();
    editor.reset();
    scheduler.reset();
  }
  std::string Text() { return shop.Text(*application, folder.path()); }
  double GainOf(const std::string& module) { return shop.Get<Source>("/demo/" + module).gain.Get(); }
  std::string SourceOfSink() { return shop.Get<Port>("/demo/sink/input/value").incoming().front()->path(); }
  void Must(const ChangeSet& changes) {
    const ChangeOutcome outcome = editor->Apply(changes);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }

  const TestFolder folder;
  SavingWorkshop shop;
  FrameworkElement* application = nullptr;
  std::optional<Scheduler> scheduler;
  std::optional<StructureEditor> editor;
  std::optional<Supervisor> supervisor;
};

TEST_F(SavedRules, HaveWhatPeopleHaveMade) {
  EXPECT_EQ(Text(), kFile);
  ASSERT_TRUE(SaveApplication(*application, shop.tools(), folder / "saved.xml"));
  EXPECT_EQ(ReadAll(folder / "saved.xml"), kFile);
  const auto saved = SaveConfiguration(*application, folder / "saved_values.xml");
  ASSERT_TRUE(saved) << saved.error().ToString();
  EXPECT_THAT(ReadAll(folder / "saved_values.xml"), HasSubstr("<value name=\"gain\">1</value>"));
}

TEST_F(SavedRules, StayTheSameWhenAllIsWellAgain) {
  for (Time now(101ms); now < Time(200ms); now += 1ms) {
    shop.Get<Source>("/demo/a").value.Publish(1);
    scheduler->RunUntil(now);
  }
  EXPECT_EQ(SourceOfSink(), "/demo/a/output/value");
  EXPECT_EQ(GainOf("gauge"), 6);
  EXPECT_EQ(Text(), kFile) << "what is not taken back is a rule's all the same";
  Must({DisconnectPorts{"/demo/a/value", "/demo/sink/value"}, ConnectPorts{"/demo/b/value", "/demo/sink/value"}});
  EXPECT_THAT(Text(), HasSubstr(R"(<connect from="b/value" to="sink/value"/>)"));
}

TEST_F(SavedRules, FollowOtherNames) {
  Must({RenameElement{"/demo/b", "c"}});
  Must({RenameElement{"/demo/a", "b"}});
  EXPECT_THAT(Text(), AllOf(HasSubstr(R"(<module name="c" type="test/source">)"),
                            HasSubstr(R"(<parameter name="count" value="5"/>)"),
                            HasSubstr(R"(<connect from="b/value" to="sink/value" queue="5"/>)"), Not(HasSubstr("\"a\"")),
                            Not(HasSubstr("own"))));
}

TEST_F(SavedRules, HaveWhatPeopleMakeMeanwhile) {
  Must({SetParameter{"/demo/gauge/gain", "9"}, SetParameter{"/demo/b/gain", "5"},
        DisconnectPorts{"/demo/b/value", "/demo/sink/value"}, ConnectPorts{"/demo/gauge/value", "/demo/sink/value"}});
  const std::string text = Text();
  EXPECT_THAT(text, AllOf(HasSubstr(R"(<parameter name="gain" value="9"/>)"),
                          HasSubstr(R"(<parameter name="gain" value="5"/>)"),
                          HasSubstr(R"(<module name="b" type="test/source">)"),
                          HasSubstr(R"(<connect from="gauge/value" to="filter/value"/>)"),
                          HasSubstr(R"(<connect from="gauge/value" to="sink/value"/>)"),
                          Not(HasSubstr(R"(<connect from="a/value")"))));
  Must({ReplaceModule{"/demo/b", "test/source"}});
  EXPECT_THAT(Text(), HasSubstr(R"(<module name="b" type="test/source">)"));
}

}  // namespace
}  // namespace runnel::testing
