// Components as processes: requests are answered, activities interrupted, the end is clean; and what the same codels do
// in Runnel.

#include <csignal>
#include <random>

#include <gmock/gmock.h>

#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/services/callable.h"
#include "plugins/testing/module_rig.h"
#include "tests/plugins/genom_standalone/standalone_process.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr const char* kMeter = RUNNEL_TEST_METER;
constexpr const char* kGuide = RUNNEL_TEST_GUIDE;

// Until the codels of the only activity go round.
void WaitUntilItTurns(StandaloneProcess& meter) {
  for (;;) {
    const Json heard = meter.Ask({{"state", true}});
    const Json& activities = heard["done"]["activities"];
    if (activities.size() == 1 && activities[0]["state"] == "turn") return;
  }
}

TEST(StandaloneTest, AnswersRequests) {
  StandaloneProcess meter(kMeter);
  EXPECT_EQ(meter.Ask({{"as", 1}, {"call", "set_gain"}, {"with", {{"gain", 3}}}}),
            Json::parse(R"({"as":1,"done":{}})"));
  EXPECT_EQ(meter.Ask({{"call", "get"}}),
            Json::parse(R"({"done":{"gain":3.0,"list":[],"name":"","which":"left","mark":{"level":0},"best":null}})"));
  EXPECT_EQ(meter.Ask({{"as", "x"}, {"call", "set_gain"}, {"with", {{"gain", 11}}}}),
            Json::parse(R"({"as":"x","failed":"meter::wrong","detail":{"which":"right","limit":10}})"));
  EXPECT_EQ(meter.Ask(Json::parse(R"({"call":"sum","with":{"values":[1,2,3],"total":10,"name":"map"}})")),
            Json::parse(R"({"done":{"total":16,"text":"the map","found":{"at":[1.5,0.1],"trace":[7,8]}}})"));
  EXPECT_EQ(meter.Ask(Json::parse(R"({"call":"sum","with":{"values":[],"total":0,"name":"broken"}})")),
            Json::parse(R"({"failed":"genom::syserr","detail":{"code":22}})"));
  EXPECT_EQ(meter.Ask(Json::parse(R"({"call":"mark","with":{"mark":{"word":"hill"},"best":2.5,"which":"right"}})")),
            Json::parse(R"({"done":{}})"));
  EXPECT_EQ(meter.Ask({{"call", "get"}})["done"],
            Json::parse(R"({"gain":3.0,"list":[],"name":"","which":"right","mark":{"word":"hill"},"best":2.5})"));
}

TEST(StandaloneTest, UnionsOwnWhatIsSet) {
  StandaloneProcess meter(kMeter);
  const auto said = [&](const std::string& what) {
    const Json value = Json::parse(what);
    EXPECT_EQ(meter.Ask({{"call", "say"}, {"with", {{"said", value}}}}), Json::parse(R"({"done":{}})"));
    return meter.Ask({{"call", "get_said"}})["done"]["said"];
  };
  for (const std::string value :
       {R"({"text":"a text that is longer than any place"})", R"({"numbers":[1,2,3]})", R"({"text":"b"})"}) {
    EXPECT_EQ(said(value), Json::parse(value));
    EXPECT_EQ(said(value), Json::parse(value));
  }
}

TEST(StandaloneTest, SaysWhatIsWrong) {
  StandaloneProcess meter(kMeter, {"--stepped"});
  const auto error = [&](const std::string& line) {
    meter.Say(line);
    const Json heard = meter.Hear();
    return heard.contains("error") ? heard["error"].get<std::string>() : heard.dump();
  };
  EXPECT_THAT(error("nonsense"), HasSubstr("is no object in JSON"));
  EXPECT_THAT(error("{}"), HasSubstr("says nothing that is to be done"));
  EXPECT_THAT(error(R"({"call":"summ"})"), HasSubstr("there is no service 'summ'; did you mean 'sum'?"));
  EXPECT_THAT(error(R"({"call":"sum"})"), HasSubstr("values: is not given"));
  EXPECT_THAT(error(R"({"call":"sum","with":{"values":[1,2,3,4,5],"total":0}})"), HasSubstr("values: has more than 4"));
  EXPECT_THAT(error(R"({"call":"sum","with":{"values":[1,true],"total":0}})"),
              HasSubstr("values[1]: is no whole number"));
  EXPECT_THAT(error(R"({"call":"sum","with":{"vlaues":[]}})"),
              HasSubstr("there is no input 'vlaues'; did you mean 'values'?"));
  EXPECT_THAT(error(R"({"call":"mark","with":{"which":"rigth","mark":{"level":1},"best":1}})"),
              HasSubstr("which: there is no 'rigth'"));
  EXPECT_THAT(error(R"({"call":"mark","with":{"which":"left","mark":{"level":300},"best":1}})"),
              HasSubstr("mark.level: 300 does not fit"));
  EXPECT_THAT(error(R"({"abort":4294967297})"), HasSubstr("'abort' is the id of an activity"));
  const std::size_t deep = 200'000;  // that is also given back to who has said it
  EXPECT_THAT(error(R"({"describe":true,"as":)" + std::string(deep, '[') + std::string(deep, ']') + "}"),
              HasSubstr("is nested deeper than 100 levels"));
  EXPECT_THAT(error(R"({"put":{"echo":1}})"), HasSubstr("echo: is an output"));
  EXPECT_THAT(error(R"({"get":"each"})"), HasSubstr("each: is a multiple port; say which: each/NAME"));
  EXPECT_THAT(error(R"({"step":-1})"), HasSubstr("is a number of seconds"));
}

TEST(StandaloneTest, StandardExceptionsHaveTheirDetailsByName) {
  StandaloneProcess meter(kMeter, {"--stepped"});
  meter.Say(R"({"as":1,"call":"count","with":{"turns":2}})");
  meter.Say(R"({"as":2,"kill":true})");
  EXPECT_EQ(meter.Hear()["as"], 2);
  EXPECT_EQ(meter.Hear(), Json::parse(R"({"as":1,"failed":"genom::interrupted","detail":{"by":"kill"}})"));
}

TEST(StandaloneTest, ActivitiesAreInterruptedAndTheEndIsClean) {
  StandaloneProcess meter(kMeter);
  const Json first = meter.Ask(Json::parse(R"({"as":1,"call":"count","with":{"turns":1000000}})"));
  EXPECT_EQ(first["as"], 1);
  EXPECT_EQ(first["accepted"], 1);
  WaitUntilItTurns(meter);
  // The second replaces the first, whose `stop` codel says how far it was.
  meter.Say(R"({"as":2,"call":"count","with":{"turns":2}})");
  Json heard = meter.Hear();
  std::string all;
  for (int i = 0; i < 2; ++i) {
    all += heard.dump() + "\n";
    heard = meter.Hear();
  }
  all += heard.dump();
  EXPECT_THAT(all, HasSubstr(R"({"as":2,"accepted":2})"));
  EXPECT_THAT(all, HasSubstr(R"({"as":1,"done":{"left":)"));
  EXPECT_THAT(all, HasSubstr(R"({"as":2,"done":{"left":0}})"));
  EXPECT_EQ(meter.Ask(Json::parse(R"({"as":3,"call":"count","with":{"turns":1000000}})"))["accepted"], 3);
  WaitUntilItTurns(meter);
  meter.Say(R"({"as":4,"abort":3})");
  all = meter.Hear().dump() + meter.Hear().dump();
  EXPECT_THAT(all, HasSubstr(R"({"as":4,"done":{}})"));
  EXPECT_THAT(all, HasSubstr(R"({"as":3,"done":{"left":)"));
  EXPECT_EQ(meter.Ask(Json::parse(R"({"as":5,"call":"count","with":{"turns":1000000}})"))["accepted"], 4);
  meter.Send(SIGTERM);
  EXPECT_EQ(meter.Hear()["as"], 5) << "what runs is ended, and answered";
  EXPECT_EQ(meter.Hear(), "gone");
  EXPECT_EQ(meter.Wait(), 0);
  EXPECT_FALSE(meter.has_socket());
}

TEST(StandaloneTest, PortsAndTimeByRequests) {
  StandaloneProcess meter(kMeter, {"--stepped"});
  EXPECT_EQ(meter.Ask({{"get", "echo"}}), Json::parse(R"({"done":null})"));
  EXPECT_EQ(meter.Ask(Json::parse(R"({"put":{"seen":{"at":[0.1,0.2],"trace":[1,2,3,4]},"range/left":0.25}})")),
            Json::parse(R"({"done":{}})"));
  EXPECT_EQ(meter.Ask({{"step", 0.02}}), Json::parse(R"({"done":{"time":0.02}})"));
  EXPECT_EQ(meter.Ask({{"get", "echo"}}), Json::parse(R"({"done":{"at":[0.2,0.4],"trace":[1,2,3,4]}})"));
  EXPECT_EQ(meter.Ask({{"get", "each/copy"}}), Json::parse(R"({"done":0.25})"));
  meter.Say(R"({"as":1,"call":"count","with":{"turns":2}})");
  EXPECT_EQ(meter.Ask({{"as", 2}, {"step", 0.02}}), Json::parse(R"({"as":1,"accepted":1})"));
  EXPECT_EQ(meter.Hear()["as"], 2);
  meter.Say(R"({"as":3,"step":0.04})");
  EXPECT_EQ(meter.Hear()["as"], 3);
  meter.Say(R"({"as":4,"step":0.02})");
  EXPECT_EQ(meter.Hear(), Json::parse(R"({"as":1,"done":{"left":0}})"));
  EXPECT_EQ(meter.Hear()["as"], 4);
  meter.Say(R"({"as":5,"call":"count","with":{"turns":3}})");
  EXPECT_EQ(meter.Ask(Json::parse(R"({"as":6,"step":0.2,"every":0.02})"))["as"], 5);
  EXPECT_EQ(meter.Hear(), Json::parse(R"({"as":5,"done":{"left":0}})"));
  EXPECT_EQ(meter.Hear()["done"], Json::parse(R"({"time":0.3})"));
  meter.Say(R"({"kill":true})");
  EXPECT_EQ(meter.Hear(), Json::parse(R"({"done":{}})"));
  EXPECT_EQ(meter.Wait(), 0);
}

TEST(StandaloneTest, DoesTheSameAsInRunnelBitForBit) {
  StandaloneProcess process(kGuide, {"--stepped"});
  ModuleRig<FrameworkElement> rig{"guide/guide", 50ms};
  auto& service = *dynamic_cast<Port&>(*rig.module.FindChild("output")->FindChild("go_to")).FindAnnotation<Callable>();
  auto call = service.NewCall();
  ASSERT_TRUE(SetFromText(*service.arguments(), "{to: {x: 4, y: 2}}", call->arguments()));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.3, 0.3);
  int moves = 0;
  for (int cycle = 0; cycle < 300; ++cycle) {
    const Pose2 pose{0.01 * cycle + noise(random), 0.3 + noise(random), noise(random) * 4};
    Surroundings around{};
    around.sensor_range = 2;
    around.safe_distance = 0.3F + static_cast<float>(noise(random)) / 10;
    around.is_measured = true;
    for (auto& each : around.contour)
      each = random() % 3 == 0 ? static_cast<std::uint16_t>(1500 + random() % 6000) : 65535;
    rig.Feed("pose", pose);
    rig.Feed("surroundings", around);
    EXPECT_EQ(process.Ask({{"put",
                            {{"pose", {{"x", pose.x}, {"y", pose.y}, {"heading", pose.heading}}},
                             {"surroundings",
                              {{"sensor_range", around.sensor_range},
                               {"safe_distance", around.safe_distance},
                               {"is_vague", around.is_vague},
                               {"is_measured", around.is_measured},
                               {"unseen_sector", around.unseen_sector},
                               {"unseen_after", around.unseen_after},
                               {"contour", around.contour}}}}}}),
              Json::parse(R"({"done":{}})"));
    if (cycle == 10) {
      EXPECT_EQ(call->Begin(rig.now(), 60s), CallStatus::kPending);
      process.Say(R"({"as":1,"call":"go_to","with":{"to":{"x":4,"y":2}}})");
    }
    rig.RunCycle();
    Json heard = process.Ask({{"as", 0}, {"step", 0.05}});
    while (heard["as"] != 0) heard = process.Hear();
    const Json said = process.Ask({{"get", "twist"}})["done"];
    bool has_published = false;
    rig.output<Twist2>("twist").VisitLatest([&](const void*, ValueTimes) { has_published = true; });
    ASSERT_EQ(!said.is_null(), has_published) << "cycle " << cycle;
    if (said.is_null()) continue;
    const Twist2 twist = rig.Last(rig.output<Twist2>("twist"));
    EXPECT_EQ(said["forward"].get<double>(), twist.forward) << "cycle " << cycle;
    EXPECT_EQ(said["turn"].get<double>(), twist.turn) << "cycle " << cycle;
    moves += twist.turn != 0;
  }
  EXPECT_GT(moves, 100);
}

}  // namespace
}  // namespace runnel::test
