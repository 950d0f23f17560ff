#include "core/port/port.h"
#include "plugins/genom_modules/component_state.h"
#include "plugins/testing/matchers.h"
#include "tests/plugins/genom_modules/component_fixture.h"

namespace runnel::test {
namespace {

TEST_F(ComponentTest, OffersItsAttributesAsServicesAndParameters) {
  rig.RunCycles(2);  // the task begins 10 ms late
  EXPECT_EQ(Call("get"),
            "{gain: 2, list: [], last: {at: {x: 0, y: 0}, where: left, name: \"\", grid: [[0, 0], [0, 0]], "
            "trace: [], level: []}}");
  EXPECT_EQ(Call("set_gain", "{gain: 3}"), "done");
  EXPECT_EQ(Call("set_list", "{list: [1, 2]}"), "done");
  EXPECT_EQ(Parameter("set_gain"), "3") << "parameters follow calls";
  EXPECT_EQ(Parameter("set_list"), "[1, 2]");
  EXPECT_THAT(Call("get"), HasSubstr("gain: 3, list: [1, 2]"));
  rig.Set("set_gain", "4");
  rig.RunCycle();
  EXPECT_THAT(Call("get"), HasSubstr("gain: 4"));
  EXPECT_EQ(Call("set_gain", "{gain: 11}"), "probe::wrong {which: right, limit: 10}");
}

TEST_F(ComponentTest, WhoSetsAParameterIsToldThatItsValueIsRefused) {
  auto& parameter = dynamic_cast<Configurable&>(*rig.module.Find("parameter/set_gain").value());
  const auto set = [&](const std::string& text) -> std::string {
    rig.Set("set_gain", text);
    EXPECT_FALSE(parameter.Outcome()) << "it has not been asked";
    rig.RunCycles(2);
    const auto outcome = parameter.Outcome();
    if (!outcome) return "not settled";
    return *outcome ? "done" : outcome->error().ToString();
  };
  EXPECT_TRUE(parameter.Outcome().value());
  rig.RunCycles(2);
  EXPECT_EQ(set("4"), "done");
  EXPECT_EQ(set("12"), "/module/parameter/set_gain: refuses the value: probe::wrong {which: right, limit: 10}");
  EXPECT_EQ(Parameter("set_gain"), "4");
  EXPECT_THAT(Call("get"), HasSubstr("gain: 4")) << "what validation refuses changes nothing";
  EXPECT_EQ(set("5"), "done");
  EXPECT_THAT(Call("get"), HasSubstr("gain: 5"));
}

// Else it would fly with a mass of 0.
TEST_F(ComponentTest, AParameterOfSeveralInputsWantsAllOfThem) {
  const auto& parameter = dynamic_cast<const Configurable&>(*rig.module.Find("parameter/set_pose").value());
  const auto said = [&](const std::string& text) -> std::string {
    const auto value = parameter.Parse(text);
    return value ? ToText(parameter.type(), value->get()) : value.error().message;
  };
  EXPECT_EQ(said("{turn: 2}"), "'mass' is not given");
  EXPECT_EQ(said("{mass: 3}"), "'turn' is not given");
  EXPECT_EQ(said("{turn: 2, mass: 3}"), "{mass: 3, turn: 2}");
  EXPECT_EQ(said("{mass: a}"), "mass: 'a' is no number");
}

TEST_F(ComponentTest, SetsParametersOfTheFileAtTheStart) {
  rig.Set("set_gain", "7");
  rig.RunCycles(2);
  EXPECT_THAT(Call("get"), HasSubstr("gain: 7"));
}

TEST_F(ComponentTest, RunsFunctionsWithTheirParameters) {
  rig.RunCycles(2);
  EXPECT_EQ(Call("sum", "{name: map, values: [1, 2, 3], total: 10}"), "{total: 16, which: right, text: \"the map\"}");
  const auto call = ServiceAt("sum").NewCall();
  EXPECT_FALSE(SetFromText(*ServiceAt("sum").arguments(), "{values: [1, 2, 3, 4, 5]}", call->arguments()));
}

// Else it would fly with a mass of 0.
TEST_F(ComponentTest, WantsAllInputsThatHaveNoDefault) {
  rig.RunCycles(2);
  const auto said = [&](const std::string& service, const std::string& text) {
    const auto call = ServiceAt(service).NewCall();
    const auto set = SetArguments(ServiceAt(service), text, *call);
    return set ? "" : set.error().message;
  };
  EXPECT_EQ(said("set_gain", "{}"), "") << "it has a default";
  EXPECT_EQ(said("wait", "{}"), "argument 'turns' is not given");
  EXPECT_EQ(said("wait", "{turns: 1}"), "");
  EXPECT_EQ(said("sum", "{name: map, total: 1}"), "argument 'values' is not given");
  EXPECT_EQ(said("abort_activity", "{}"), "argument 'id' is not given");
  EXPECT_FALSE(ServiceAt("sum").are_arguments_optional());
  EXPECT_TRUE(ServiceAt("get").are_arguments_optional());
}

TEST_F(ComponentTest, ReadsAndWritesItsPortsInItsPasses) {
  Port& seen = PortAt("seen");
  auto source = seen.MakeOutput(rig.runtime.root(), "source", {});
  ASSERT_TRUE(Port::Connect(*source, seen));
  const auto feed = [&](const std::string& text) {
    ASSERT_TRUE(source->PublishFilled([&](void* value) { return SetFromText(seen.type(), text, value); }, rig.now()));
  };
  feed("{at: {x: 2, y: 1}, where: right, name: wall, grid: [[1, 2], [3, 4]], trace: [{x: 1, y: 0}], level: [5]}");
  rig.RunCycles(2);
  EXPECT_EQ(Newest("echo"),
            "{at: {x: 4, y: 1}, where: right, name: \"wall\", grid: [[1, 2], [3, 4]], "
            "trace: [{x: 1, y: 0}], level: [5]}");
  feed("{at: {x: 3}}");
  rig.RunCycle();
  EXPECT_THAT(Newest("echo"), HasSubstr("x: 4")) << "between two ticks nothing runs";
  rig.RunCycle();
  EXPECT_THAT(Newest("echo"), HasSubstr("x: 6"));
}

TEST_F(ComponentTest, PublishesWhatIsAsOldAsWhatItsActivityHasRead) {
  const auto aimed_at = [&] {
    Time stamp{};
    PortAt("aimed").VisitLatest([&](const void*, ValueTimes times) { stamp = times.timestamp; });
    return stamp;
  };
  const Time measured = rig.now();
  rig.Feed("sighted", 2.5);
  rig.RunCycles(2);
  const auto look = Begin("look");
  rig.RunCycles(6);
  EXPECT_EQ(aimed_at(), measured) << "it was read in a cycle before, by another codel";
  EXPECT_TRUE(ServiceAt("look").Abort());
  rig.RunCycles(4);
  const auto guess = Begin("guess");
  rig.RunCycles(6);
  EXPECT_GE(aimed_at() + 20ms, rig.now()) << "what has ended does not age what others do";
  EXPECT_TRUE(ServiceAt("guess").Abort());
  rig.RunCycles(4);
  const auto looking = Begin("guess", "{looks: true}");
  rig.RunCycles(6);
  EXPECT_EQ(aimed_at(), measured);
  EXPECT_TRUE(ServiceAt("guess").Abort());
  rig.RunCycles(4);
  const auto again = Begin("guess");
  rig.RunCycles(6);
  EXPECT_GE(aimed_at() + 20ms, rig.now()) << "nor what the same service does, by the same request";
}

TEST_F(ComponentTest, HasMultiplePortsOfTheNamesThatAreGiven) {
  rig.Set("many", "[left, right]");
  rig.Set("copies", "[a]");
  rig.RunCycles(2);
  auto& left = dynamic_cast<Port&>(*rig.module.FindChild("input")->FindChild("many")->FindChild("left"));
  Output<double> source(rig.runtime.root(), "source");
  ASSERT_TRUE(Port::Connect(source, left));
  source.Publish(2.5);
  EXPECT_EQ(Call("copy", "{from: left, to: a}"), "2.5");
  const auto& copy =
      dynamic_cast<Output<double>&>(*rig.module.FindChild("output")->FindChild("copies")->FindChild("a"));
  EXPECT_EQ(rig.Last(copy), 2.5);
  EXPECT_EQ(Call("copy", "{from: right, to: a}"), "-1") << "nothing has come there";
  EXPECT_THAT(Call("copy", "{from: left, to: b}"), HasSubstr("mwerr"));
}

TEST_F(ComponentTest, WhatIsOldIsForCodelsAsIfNothingHadCome) {
  rig.Set("many", "[left]");
  rig.Set("copies", "[a]");
  rig.RunCycles(2);
  auto& left = dynamic_cast<Port&>(*rig.module.FindChild("input")->FindChild("many")->FindChild("left"));
  Output<double> source(rig.runtime.root(), "source");
  ASSERT_TRUE(Port::Connect(source, left));
  source.Publish(2.5);
  EXPECT_EQ(Call("copy", "{from: left, to: a}"), "2.5");
  rig.RunCycles(60);
  EXPECT_EQ(Call("copy", "{from: left, to: a}"), "-1");
  rig.Set("many_left_timeout", "3600");
  EXPECT_EQ(Call("copy", "{from: left, to: a}"), "2.5");
  EXPECT_TRUE(rig.module.Find("parameter/sighted_timeout"));
}

TEST_F(ComponentTest, TellsWhatActivitiesDo) {
  rig.RunCycles(2);
  const auto wait = Begin("wait", "{turns: 3}");
  rig.RunCycles(3);
  const ServiceState state = ServiceAt("wait").state();
  ASSERT_EQ(state.running.size(), 1u);
  EXPECT_EQ(state.running[0].doing, "turn");
  EXPECT_STREQ(wait->doing(), "turn");
  auto& seen = rig.Follow(rig.output<genom_modules::ComponentState>("genom_state"));
  rig.RunCycle();
  EXPECT_THAT(TextOf(*seen.Read()), HasSubstr("activities: [{id: 1, service: \"wait\", state: \"turn\"}]"));
  rig.RunCycles(6);
  EXPECT_EQ(Outcome("wait", *wait), "3");
}

TEST_F(ComponentTest, ServesNoCallFromBeforeAStop) {
  rig.RunCycles(2);
  const auto wait = Begin("wait", "{turns: 3}");
  RobotStop& stop = rig.runtime.robot_stop();
  stop.Press("a person");
  ASSERT_TRUE(stop.Release("a person"));
  rig.RunCycles(6);
  EXPECT_THAT(Outcome("wait", *wait), HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_EQ(Call("wait", "{turns: 1}"), "1");
}

TEST_F(ComponentTest, TellsOfEachInstanceOfAnActivity) {
  rig.RunCycles(2);
  const auto first = Begin("tick", "{turns: 100}");
  const auto second = Begin("tick", "{turns: 3}");
  rig.RunCycles(3);
  auto running = ServiceAt("tick").state().running;
  ASSERT_EQ(running.size(), 2u);
  EXPECT_EQ(running[0].number, 1u);
  EXPECT_EQ(running[1].number, 2u);
  EXPECT_EQ(running[1].doing, "turn");
  rig.RunCycles(6);
  EXPECT_EQ(Outcome("tick", *second), "3");
  running = ServiceAt("tick").state().running;
  ASSERT_EQ(running.size(), 1u);
  EXPECT_EQ(running[0].number, 1u);
  const auto third = Begin("tick", "{turns: 100}");
  rig.RunCycles(3);
  EXPECT_TRUE(ServiceAt("tick").Abort()) << "all that is under way";
  rig.RunCycles(3);
  EXPECT_THAT(Outcome("tick", *first), HasSubstr("aborted: interrupted {by: abort_activity}"));
  EXPECT_THAT(Outcome("tick", *third), HasSubstr("aborted: interrupted {by: abort_activity}"));
  EXPECT_FALSE(ServiceAt("tick").Abort());
}

TEST_F(ComponentTest, InterruptsActivities) {
  rig.RunCycles(2);
  const auto first = Begin("wait", "{turns: 100}");
  rig.RunCycles(3);
  const auto second = Begin("wait", "{turns: 100}");
  rig.RunCycles(4);
  EXPECT_THAT(Outcome("wait", *first), testing::StartsWith("109")) << "the codel of `stop` has the last word";
  EXPECT_EQ(Call("abort_activity", "{id: 2}"), "done");
  rig.RunCycles(2);
  EXPECT_THAT(Outcome("wait", *second), testing::StartsWith("10"));
  EXPECT_THAT(Call("abort_activity", "{id: 2}"), HasSubstr("no_such_activity"));
  const auto third = Begin("wait", "{turns: 100}");
  rig.RunCycles(3);
  EXPECT_TRUE(ServiceAt("wait").Abort());
  rig.RunCycles(3);
  EXPECT_THAT(Outcome("wait", *third), testing::StartsWith("10"));
}

TEST_F(ComponentTest, RunsAsynchronousCodelsElsewhere) {
  rig.RunCycles(2);
  EXPECT_EQ(Call("slow", "", 1), "true") << "on a clock that is not the machine's a cycle waits for them";
}

TEST_F(ComponentTest, AllocatesNothingInItsCycles) {
  rig.RunCycles(10);
  auto call = ServiceAt("wait").NewCall();
  ASSERT_TRUE(SetFromText(*ServiceAt("wait").arguments(), "{turns: 2}", call->arguments()));
  ASSERT_EQ(call->Begin(rig.now(), 10s), CallStatus::kPending);
  EXPECT_TRUE(RunWatched(rig, 10).empty());
  ASSERT_EQ(call->Poll(rig.now()), CallStatus::kAnswered);
}

}  // namespace
}  // namespace runnel::test
