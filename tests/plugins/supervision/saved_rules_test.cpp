// A file that is saved while a rule is in force has what people have made, and not what the rule has made for the time
// being.

#include <memory>
#include <string>
#include <utility>

#include <gmock/gmock.h>

#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "core/paths/distant_ports.h"
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

class RulesInForce : public ::testing::Test {
 protected:
  // Until the source that publishes nothing is stale: all rules are about it.
  void Run(const std::string& file, const ChangeSet& before = {}) {
    WriteAll(folder / "app.xml", file);
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
    EXPECT_EQ(Text(), file);
    Must(before);
    scheduler->RunUntil(Time(100ms));
  }
  // Until its values come again.
  void RunOn() {
    for (Time now(101ms); now < Time(200ms); now += 1ms) {
      shop.Get<Source>("/demo/a").value.Publish(1);
      scheduler->RunUntil(now);
    }
  }
  RulesInForce() { shop.Add<Spare>("test/spare"); }
  ~RulesInForce() override {
    supervisor.reset();
    editor.reset();
    scheduler.reset();
  }
  std::string Text() { return shop.Text(*application, folder.path()); }
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

class SavedRules : public RulesInForce {
 protected:
  SavedRules() {
    Run(kFile);
    EXPECT_EQ(shop.Get<Spare>("/demo/b").gain.Get(), 3);
    EXPECT_EQ(GainOf("gauge"), 2);
    EXPECT_EQ(SourceOfSink(), "/demo/b/output/value");
    EXPECT_TRUE(shop.Get<Port>("/demo/filter/input/value").incoming().empty()) << "though its module requires it";
  }
  double GainOf(const std::string& module) { return shop.Get<Source>("/demo/" + module).gain.Get(); }
};

TEST_F(SavedRules, HaveWhatPeopleHaveMade) {
  EXPECT_EQ(Text(), kFile);
  ASSERT_TRUE(SaveApplication(application->runtime(), *application, shop.tools(), folder / "saved.xml"));
  EXPECT_EQ(ReadAll(folder / "saved.xml"), kFile);
  const auto saved = SaveConfiguration(*application, folder / "saved_values.xml");
  ASSERT_TRUE(saved) << saved.error().ToString();
  EXPECT_THAT(ReadAll(folder / "saved_values.xml"), HasSubstr("<value name=\"gain\">1</value>"));
}

TEST_F(SavedRules, StayTheSameWhenAllIsWellAgain) {
  RunOn();
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
                            HasSubstr(R"(<connect from="b/value" to="sink/value" queue="5"/>)"),
                            Not(HasSubstr("\"a\"")), Not(HasSubstr("own"))));
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

// `modules`: what the application has besides. `reaction`, `otherwise`: what the rule does.
std::string FileWith(const std::string& modules, const std::string& reaction, const std::string& otherwise = "") {
  return R"(<application name="demo">
  <module name="a" type="test/source"/>
)" + modules +
         R"(  <module name="sink" type="test/sink"/>
  <connect from="a/value" to="sink/value"/>
  <on_stale input="sink/value" after="30ms" fresh_after="20ms">
    )" + reaction +
         "\n" + (otherwise.empty() ? "" : "    <otherwise>\n      " + otherwise + "\n    </otherwise>\n") +
         R"(  </on_stale>
</application>
)";
}

TEST_F(RulesInForce, LeaveWhatAGroupSaysOfAParameterThatTheReplacementLacks) {
  const std::string file = FileWith(R"(  <group name="both">
    <parameter name="count" to="b/count" value="5"/>
    <module name="b" type="test/source">
      <parameter name="gain" value="3"/>
    </module>
  </group>
)",
                                    R"(<replace module="both/b" by="test/spare"/>)");
  Run(file);
  ASSERT_EQ(shop.Get<Spare>("/demo/both/b").gain.Get(), 3);
  EXPECT_EQ(Text(), file);
}

TEST_F(RulesInForce, LeaveWhatIsSaidOfPortsThatTheReplacementLacks) {
  const std::string file = FileWith(R"(  <module name="b" type="test/sink"/>
  <driving port="b/second" safe="0" command="effort"/>
)",
                                    R"(<replace module="b" by="test/spare"/>)");
  Run(file);
  (void)shop.Get<Spare>("/demo/b");
  EXPECT_EQ(Text(), file);
}

TEST_F(RulesInForce, AModuleThatComesBackHasTheMarksThatTheReplacementLacks) {
  Run(FileWith(R"(  <module name="b" type="test/sink"/>
  <driving port="b/second" safe="3" command="effort"/>
)",
               R"(<replace module="b" by="test/spare"/>)", R"(<replace module="b" by="test/sink"/>)"));
  (void)shop.Get<Spare>("/demo/b");
  RunOn();
  const auto& port = shop.Get<Port>("/demo/b/input/second");
  ASSERT_TRUE(port.is_driving());
  EXPECT_EQ(ToText(port.type(), port.stop()->safe_value().get()), "3");
}

TEST_F(RulesInForce, HaveWhatPeopleHaveSetBeforeAtWhatTheReplacementLacks) {
  const ChangeSet settings = {SetParameter{"/demo/b/count", "9"}, SetParameter{"/demo/b/gain", "4"}};
  Run(FileWith("  <module name=\"b\" type=\"test/source\"/>\n", R"(<replace module="b" by="test/spare"/>)"), settings);
  (void)shop.Get<Spare>("/demo/b");
  EXPECT_THAT(Text(), HasSubstr(R"(  <module name="b" type="test/source">
    <parameter name="gain" value="4"/>
    <parameter name="count" value="9"/>
  </module>
)"));
}

TEST_F(RulesInForce, KeepWhatWasSaidOfAParameterWhenTheModuleIsBack) {
  const std::string module = R"(  <module name="b" type="test/source">
    <parameter name="gain" value="3"/>
    <parameter name="count" value="5"/>
  </module>
)";
  const std::string file =
      FileWith(module, R"(<replace module="b" by="test/spare"/>)", R"(<replace module="b" by="test/source"/>)");
  Run(file);
  EXPECT_EQ(Text(), file);
  RunOn();
  ASSERT_EQ(shop.Get<Source>("/demo/b").count.Get(), 3) << "a rule takes nothing back by itself";
  EXPECT_EQ(Text(), file);
  scheduler->RunUntil(Time(400ms));  // it is stale again
  (void)shop.Get<Spare>("/demo/b");
  EXPECT_EQ(Text(), file);
}

TEST_F(RulesInForce, ChangeWhatIsSaidOfAParameterThatTheReplacementLacks) {
  const std::string module = R"(  <module name="b" type="test/source">
    <parameter name="gain" value="3"/>
    <parameter name="count" value="5"/>
  </module>
)";
  Run(FileWith(module, R"(<replace module="b" by="test/spare"/>)"), {SetParameter{"/demo/b/count", "9"}});
  (void)shop.Get<Spare>("/demo/b");
  EXPECT_THAT(Text(), AllOf(HasSubstr(R"(<parameter name="count" value="9"/>)"), Not(HasSubstr(R"(value="5")"))));
}

TEST_F(RulesInForce, KeepTheOnlyConnectionOfARequiredInput) {
  const std::string file =
      FileWith(R"(  <module name="f" type="test/filter"/>
  <connect from="a/value" to="f/value"/>
)",
               R"(<switch input="f/value" from="a/value"/>)", R"(<switch input="f/value" to="a/value"/>)");
  Run(file);
  ASSERT_TRUE(shop.Get<Port>("/demo/f/input/value").incoming().empty());
  EXPECT_EQ(Text(), file);
}

/// Stands for a network with one port of another application.
class OtherApplication final : public DistantPorts {
 public:
  struct Element final : Group {
    explicit Element(const Placement& placement) : Group(placement) {
      Annotate(std::make_unique<NotSaved>());
      value.Annotate(std::make_unique<DistantPort>("//far/a/value"));
    }
    Output<double> value{*this, "value"};
  };
  [[nodiscard]] Port* Find(std::string_view path) const override {
    return element != nullptr && path == "//far/a/value" ? &element->value : nullptr;
  }
  [[nodiscard]] DistantType TypeOf(std::string_view) const override { return {&runnel::TypeOf<double>()}; }
  Result<Port*> Make(std::string_view, const Port& to, const ConnectOptions&) override {
    FrameworkElement* application = to.parent();
    while (application->parent()->parent() != nullptr) application = application->parent();
    if (element == nullptr) element = &to.runtime().Create<Element>(*application, "network");
    return &element->value;
  }
  Element* element = nullptr;
};

TEST_F(RulesInForce, KeepTheConnectionToAnotherApplication) {
  auto made = std::make_unique<OtherApplication>();
  OtherApplication& other = *made;
  shop.runtime.root().Annotate<DistantPorts>(std::move(made));
  const std::string file = R"(<application name="demo">
  <module name="b" type="test/source"/>
  <module name="sink" type="test/sink"/>
  <connect from="//far/a/value" to="sink/value"/>
  <on_stale input="sink/value" after="30ms" fresh_after="20ms">
    <switch input="sink/value" from="//far/a/value" to="b/value"/>
  </on_stale>
</application>
)";
  Run(file);
  ASSERT_EQ(SourceOfSink(), "/demo/b/output/value");
  EXPECT_EQ(Text(), file);
  ASSERT_TRUE(shop.runtime.Delete(*std::exchange(other.element, nullptr)));
  EXPECT_EQ(Text(), file) << "also when the other application has ended";
}

// What a file or a person has set, though one of the two modules has it by itself.
class RulesInForceAndDefaults : public RulesInForce, public ::testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(, RulesInForceAndDefaults, ::testing::Values("1", "3", "7"));

TEST_P(RulesInForceAndDefaults, AreSaved) {
  const std::string file =
      FileWith(R"(  <module name="b" type="test/source">
    <parameter name="gain" value=")" +
                   GetParam() + R"("/>
  </module>
)",
               R"(<replace module="b" by="test/spare"/>)", R"(<replace module="b" by="test/source"/>)");
  const bool is_of_person = GetParam() == "3";
  Run(file, is_of_person ? ChangeSet{SetParameter{"/demo/b/gain", "1"}} : ChangeSet());
  const std::string saved = is_of_person ? "1" : GetParam();
  EXPECT_THAT(Text(), HasSubstr(R"(<parameter name="gain" value=")" + saved + R"("/>)"));
  RunOn();
  EXPECT_EQ(shop.Get<Source>("/demo/b").gain.Get(), std::stod(saved));
  EXPECT_THAT(Text(), HasSubstr(R"(<parameter name="gain" value=")" + saved + R"("/>)"));
}

}  // namespace
}  // namespace runnel::testing
