// The component of mill.gen, whose codels are in C++.

#include "core/module/hand_over.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/port.h"
#include "tests/plugins/genom_modules/component_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

class ComponentInCxxTest : public ComponentTest {
 protected:
  ComponentInCxxTest() : ComponentTest("mill/mill") { plugins_.AddSearchFolder(RUNNEL_TEST_PLUGIN_FOLDER); }

  void Feed(const std::string& text) {
    Port& seen = PortAt("seen");
    if (source_ == nullptr) {
      source_ = seen.MakeOutput(rig.runtime.root(), "source", {});
      ASSERT_TRUE(Port::Connect(*source_, seen));
    }
    ASSERT_TRUE(source_->PublishFilled([&](void* value) { return SetFromText(seen.type(), text, value); }, rig.now()));
  }

  PluginManager plugins_;

 private:
  std::unique_ptr<Port> source_;
};

TEST_F(ComponentInCxxTest, RunsItsCodelsInTheirOrder) {
  rig.Set("grain", "[left]");
  rig.Set("flour", "[a]");
  rig.RunCycle();
  Feed("{at: {x: 1, y: 2}}");
  rig.RunCycles(2);
  EXPECT_EQ(Call("set_gain", "{gain: 3}"), "done");
  EXPECT_EQ(Call("beep", "{times: 4}"), "8");
  auto& left = dynamic_cast<Port&>(*rig.module.FindChild("input")->FindChild("grain")->FindChild("left"));
  Output<double> grain(rig.runtime.root(), "a_grain");
  ASSERT_TRUE(Port::Connect(grain, left));
  grain.Publish(2.5);
  EXPECT_EQ(Call("pour", "{from: left, to: a, names: [one, two]}"), "{value: 2.5, said: \"onetwo\"}");
  EXPECT_EQ(Call("turns", "{times: 0}"), "0");
  EXPECT_EQ(
      Call("get_trace"),
      R"(["begin", "nothing seen", "pass", "check", "beep", "pass", "pass", "open", "pour", "pass", "last onetwo", "pass", "first"])");
}

TEST_F(ComponentInCxxTest, ReadsAndWritesItsPorts) {
  rig.RunCycle();
  Feed("{at: {x: 2, y: 1}, where: right, name: wall, grid: [[1, 2], [3, 4]], trace: [{x: 1, y: 0}], level: [5]}");
  rig.RunCycles(2);
  EXPECT_EQ(Newest("ground"),
            "{at: {x: 4, y: 1}, where: right, name: \"wall\", grid: [[1, 2], [3, 4]], "
            "trace: [{x: 1, y: 0}, {x: 2, y: 1}], level: [5]}");
  rig.RunCycles(2);
  EXPECT_EQ(Newest("way"), "[{x: 2, y: 1}, {x: 2, y: 1}]") << "a list without a bound";
  EXPECT_THAT(Call("get_all"), HasSubstr("last: {at: {x: 2, y: 1}, where: right, name: \"wall\""));
}

TEST_F(ComponentInCxxTest, TakesValuesOfEveryKind) {
  rig.RunCycle();
  EXPECT_EQ(Call("set_all", "{corners: [{x: 1, y: 2}], level: [7], words: [up, down], flags: [true, false]}"), "done");
  EXPECT_THAT(Call("get_all"),
              HasSubstr(R"(corners: [{x: 1, y: 2}], level: [7], words: ["up", "down"], flags: [true, false])"));
  const auto call = ServiceAt("set_all").NewCall();
  EXPECT_FALSE(SetFromText(*ServiceAt("set_all").arguments(), "{corners: [{}, {}, {}, {}]}", call->arguments()));
  const auto partly = SetArguments(ServiceAt("set_all"),
                                   "{corners: [{x: 1}], level: [7], words: [up, down], flags: [true, false]}", *call);
  EXPECT_EQ(partly ? "" : partly.error().message, "'y' is not given") << "it would be 0";
}

TEST_F(ComponentInCxxTest, TakesWhatACallLeavesOutFromTheDescription) {
  rig.RunCycle();
  const auto call = ServiceAt("say").NewCall();
  EXPECT_EQ(
      ToText(*ServiceAt("say").arguments(), call->arguments()),
      "{what: \"a \\\"word\\\"\", where: right, three: [1, 0, 3], seen: {at: {x: 0, y: 2}, where: left, name: \"\", "
      "grid: [[0, 0], [0, 0]], trace: [{x: 0, y: 0}, {x: 3, y: 4}], level: []}, level: [7]}");
  EXPECT_EQ(Call("say", "{}"), "a \"word\" right 11 2 2");
  EXPECT_EQ(Call("say", "{what: no, seen: {at: {y: 3}}, level: []}"), "no right 11 3 2");
}

TEST_F(ComponentInCxxTest, AnswersWithTheExceptionsThatItsCodelsThrow) {
  rig.RunCycle();
  EXPECT_EQ(Call("set_gain", "{gain: 11}"), "mill::jammed {which: left, by: \"gain\"}");
  EXPECT_EQ(Call("set_gain", "{gain: -1}"), "mill::worn");
  EXPECT_EQ(Call("beep", "{times: 11}"), "beeper::tired {which: right, limit: 11}");
  EXPECT_THAT(Call("pour", "{from: nowhere, to: a}"), HasSubstr("mwerr"));
}

TEST_F(ComponentInCxxTest, EndsItsActivitiesByTheirLastCodels) {
  rig.RunCycle();
  const auto first = Begin("turns", "{times: 50}");
  rig.RunCycles(4);
  const auto second = Begin("turns", "{times: 50}");
  rig.RunCycles(4);
  EXPECT_THAT(Outcome("turns", *first), testing::StartsWith("10"));
  EXPECT_TRUE(ServiceAt("turns").Abort());
  rig.RunCycles(4);
  EXPECT_THAT(Outcome("turns", *second), testing::StartsWith("10"));
  EXPECT_THAT(Call("get_trace"),
              HasSubstr(R"("first", "nothing seen", "nothing seen", "stop", "nothing seen", "first")"));
}

TEST_F(ComponentInCxxTest, IsStoppedByWhatIsNoExceptionOfIts) {
  rig.RunCycle();
  const auto call = Begin("turns", "{times: 77}");
  const auto fault = rig.RunUntilFault(200);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->message, HasSubstr("a mistake"));
}

// A codel that is away writes what would be handed over.
TEST_F(ComponentInCxxTest, NoneTakesItsPlaceWhileACodelIsAwayAlsoWhereAMistakeHasEndedIt) {
  ASSERT_TRUE(plugins_.Load("probe"));
  FrameworkElement* const other = *plugins_.modules().Create("probe/probe", rig.runtime.root(), "other");  // never runs
  ASSERT_TRUE(Port::Connect(PortOf(*other, "sum"), PortAt("sum")));
  rig.RunCycle();
  const auto away = Begin("add", "{name: map, values: [1, 2]}");
  const auto has_called = [&] {
    rig.RunCycle();
    return PortOf(*other, "sum").FindAnnotation<Callable>()->state().waiting == 1;
  };
  WaitUntil("it has called", has_called, std::chrono::seconds(100));
  const auto call = Begin("turns", "{times: 77}");
  const auto fault = rig.RunUntilFault(200);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->message, HasSubstr("a mistake"));
  EXPECT_THAT([&] { rig.module.FindAnnotation<BeforeHandOver>()->settle(); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("asynchronous codels does not come back")));
}

TEST_F(ComponentInCxxTest, IsStoppedByAPermanentActivityThatThrows) {
  rig.RunCycle();
  Feed("{at: {x: 99}}");
  const auto fault = rig.RunUntilFault(4);
  ASSERT_TRUE(fault.has_value());
  EXPECT_THAT(fault->message, HasSubstr("mill::jammed {which: right, by: \"sand\"}"));
}

}  // namespace
}  // namespace runnel::test
