// Rules watch what they were written for, whatever has become of it since.

#include <gmock/gmock.h>

#include "plugins/application_tags/run_description.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/structure_editor.h"
#include "tests/plugins/application_files/reading/test_application.h"
#include "tests/plugins/supervision/notices.h"

namespace runnel::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Publishes its number in each cycle; 0: it is silent, -1: it throws.
class Sensor final : public Module {
 public:
  using Module::Module;
  Output<double> out{this, "out"};
  Parameter<double> number{this, "number", {.default_value = 0.0}};

 private:
  void Update() override {
    if (number.Get() < 0) throw std::runtime_error("worn out");
    if (number.Get() > 0) out.Publish(number.Get());
  }
};

class Reader final : public Module {
 public:
  using Module::Module;
  Input<double> in{this, "in"};
  Output<double> out{this, "out"};

 private:
  void Update() override { out.Publish(in.Get()); }
};

constexpr const char* kRules = R"(<application name="demo">
  <clock type="simulated" speed="0"/>
  <thread name="control" period="10ms"/>
  <group name="g">
    <module name="a" type="test/sensor"><parameter name="number" value="1"/></module>
    <module name="b" type="test/sensor"><parameter name="number" value="2"/></module>
    <module name="sink" type="test/reader"/>
    <connect from="a/out" to="sink/in"/>
  </group>
  <on_stale input="g/sink/in" after="30ms" fresh_after="20ms">
    <switch input="g/sink/in" from="g/a/out" to="g/b/out"/>
    <otherwise><switch input="g/sink/in" from="g/b/out" to="g/a/out"/></otherwise>
  </on_stale>
  <on_pause of="g/a"><publish port="g/sink/in" value="9"/></on_pause>
  <on_stuck of="g/a" after="60min"><quit/></on_stuck>
  <latency from="g/a/out" to="g/sink/out"/>
  <on_fault of="g/b" set="g/a/number" value="5"/>
</application>)";

struct Operation {
  const char* name;
  std::vector<ChangeSet> done;
  int undone = 0;
  // What is called so after it.
  std::string a = "/demo/g/a";
  std::string b = "/demo/g/b";
  std::string sink = "/demo/g/sink";
};

class NamesOfRules : public ::testing::TestWithParam<Operation>, public Workshop {
 protected:
  NamesOfRules() {
    Add<Sensor>("test/sensor");
    Add<Reader>("test/reader");
  }
  void Start() {
    FrameworkElement* const application = Build(kRules);
    ASSERT_TRUE(application) << diagnostics.ToString();
    scheduler.emplace(runtime, SchedulerOptionsOf(*application));
    editor.emplace(runtime, plugins.modules(), &*scheduler);
    history.emplace(*editor);
    supervisor.emplace(runtime, *scheduler, [this](const ChangeSet& changes) -> Result<ChangeSet> {
      const ChangeOutcome outcome = editor->Apply(changes);
      return outcome ? Result(ChangeSet()) : outcome.diagnostics.errors().front();
    });
    ASSERT_TRUE(AddRules(*application, *scheduler, *supervisor));
  }
  void RunOn() { scheduler->RunUntil(runtime.clock().Now() + std::chrono::milliseconds(100)); }
  void Set(const std::string& module, const char* number) {
    const auto outcome = editor->Apply({SetParameter{module + "/parameter/number", number}});
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  double Seen() { return Get<Reader>(GetParam().sink).in.Get(); }
  std::vector<std::string> Messages() {
    std::vector<std::string> messages;
    for (const Notice& each : test::NoticesOf(*supervisor)) messages.push_back(each.path + " " + each.message);
    return messages;
  }

  std::optional<Scheduler> scheduler;
  std::optional<StructureEditor> editor;
  std::optional<ChangeHistory> history;
  std::optional<Supervisor> supervisor;
};

TEST_P(NamesOfRules, AreThoseOfWhatTheyWereWrittenFor) {
  ASSERT_NO_FATAL_FAILURE(Start());
  RunOn();
  const auto& [name, done, undone, a, b, sink] = GetParam();
  for (const ChangeSet& each : done) {
    const auto outcome = history->Apply(each);
    ASSERT_TRUE(outcome) << outcome.diagnostics.ToString();
  }
  for (int i = 0; i < undone; ++i) ASSERT_TRUE(history->Undo());
  RunOn();
  EXPECT_EQ(Seen(), 1);
  EXPECT_THAT(Messages(), ::testing::IsEmpty());

  Set(a, "0");
  RunOn();
  EXPECT_EQ(Seen(), 2) << "its source is silent";
  EXPECT_THAT(Messages(), Contains(HasSubstr("; switched " + sink + "/input/in from " + a + "/output/out to " + b +
                                             "/output/out")));
  Set(a, "1");
  RunOn();
  EXPECT_EQ(Seen(), 1) << "it is back";
  EXPECT_THAT(Messages(), Contains(HasSubstr(sink + "/input/in values come again")));

  ASSERT_TRUE(supervisor->SetPaused(a, true));
  EXPECT_EQ(Seen(), 9);
  EXPECT_THAT(Messages(), Contains(HasSubstr(a + " is paused; published 9 at " + sink)));
  ASSERT_TRUE(supervisor->SetPaused(a, false));

  Set(b, "-1");
  RunOn();
  EXPECT_EQ(Get<Sensor>(a).number.Get(), 5);
  EXPECT_THAT(Messages(), Contains(HasSubstr(b + " has failed; set " + a + "/parameter/number to 5")));

  EXPECT_THAT(scheduler->StuckRules(), Contains(::testing::Field(&StuckRule::of, a)));
  ASSERT_EQ(scheduler->ReadLatencies().size(), 1u);
  EXPECT_EQ(scheduler->ReadLatencies()[0].request, (LatencyRequest{a + "/output/out", sink + "/output/out"}));
}

using MissingPorts = NamesOfRules;

TEST_P(MissingPorts, HaveTheirSafeValueWhenAnUndoBringsThemBack) {
  ASSERT_NO_FATAL_FAILURE(Start());
  RunOn();
  ASSERT_TRUE(history->Apply({DeleteElement{GetParam().sink}}));
  RunOn();
  ASSERT_TRUE(supervisor->SetPaused(GetParam().a, true));
  EXPECT_THAT(Messages(), Contains(HasSubstr("what was to be done about it failed")));
  ASSERT_TRUE(history->Undo());
  RunOn();
  EXPECT_EQ(Seen(), 9);
  EXPECT_THAT(Messages(), Contains(HasSubstr("is there again; what a rule wants there meanwhile is set")));
  ASSERT_TRUE(supervisor->SetPaused(GetParam().a, false));
  RunOn();
  EXPECT_EQ(Seen(), 1);
}

TEST_P(MissingPorts, AreDrivenWhereTheRuleHasEndedMeanwhile) {
  ASSERT_NO_FATAL_FAILURE(Start());
  RunOn();
  ASSERT_TRUE(history->Apply({DeleteElement{GetParam().sink}}));
  ASSERT_TRUE(supervisor->SetPaused(GetParam().a, true));
  ASSERT_TRUE(supervisor->SetPaused(GetParam().a, false));
  ASSERT_TRUE(history->Undo());
  RunOn();
  EXPECT_EQ(Seen(), 1);
}

INSTANTIATE_TEST_SUITE_P(Rules, MissingPorts, ::testing::Values(Operation{.name = "delete", .done = {}}));

INSTANTIATE_TEST_SUITE_P(
    Operations, NamesOfRules,
    ::testing::Values(
        Operation{.name = "nothing", .done = {}},
        Operation{.name = "rename_of_the_source", .done = {{RenameElement{"/demo/g/a", "ab"}}}, .a = "/demo/g/ab"},
        Operation{.name = "rename_of_the_other", .done = {{RenameElement{"/demo/g/b", "c"}}}, .b = "/demo/g/c"},
        Operation{
            .name = "rename_of_the_reader", .done = {{RenameElement{"/demo/g/sink", "end"}}}, .sink = "/demo/g/end"},
        Operation{.name = "rename_of_the_group",
                  .done = {{RenameElement{"/demo/g", "h"}}},
                  .a = "/demo/h/a",
                  .b = "/demo/h/b",
                  .sink = "/demo/h/sink"},
        Operation{.name = "exchange_of_names",
                  .done = {{RenameElement{"/demo/g/a", "x"}},
                           {RenameElement{"/demo/g/b", "a"}},
                           {RenameElement{"/demo/g/x", "b"}}},
                  .a = "/demo/g/b",
                  .b = "/demo/g/a"},
        Operation{.name = "rename_and_undo", .done = {{RenameElement{"/demo/g/a", "x"}}}, .undone = 1},
        Operation{.name = "swap", .done = {{ReplaceModule{"/demo/g/a", "test/sensor"}}}},
        Operation{.name = "swap_and_undo", .done = {{ReplaceModule{"/demo/g/a", "test/sensor"}}}, .undone = 1},
        Operation{.name = "delete_and_undo", .done = {{DeleteElement{"/demo/g/a"}}}, .undone = 1},
        Operation{.name = "rename_delete_and_undo_of_both",
                  .done = {{RenameElement{"/demo/g/a", "x"}}, {DeleteElement{"/demo/g/x"}}},
                  .undone = 2},
        Operation{.name = "copy", .done = {{CopyElement{"/demo/g/a", "x"}}}}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace runnel::testing
