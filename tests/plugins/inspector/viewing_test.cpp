#include <atomic>
#include <cmath>
#include <thread>

#include "tests/plugins/inspector/inspector_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

namespace {

using Viewing = RunningInspectorTest;
using SimulatedViewing = SimulatedInspectorTest;

/// Does not return from its cycle as long as somebody wants that.
class Hanging final : public Module {
 public:
  using Module::Module;
  static inline std::atomic<bool> hangs{false};

 private:
  void Update() override {
    while (hangs.load()) std::this_thread::sleep_for(1ms);
  }
};

TEST_F(Viewing, BeginsWithWhoIsThere) {
  Start({.application = {}, .file = "/here/app.xml", .version = "0.1.0", .is_read_only = true});
  const auto first = View().raw().Receive(1);
  ASSERT_TRUE(first);
  const Json hello = Json::parse(first->payload);
  EXPECT_EQ(hello["op"], "hello");
  EXPECT_EQ(hello["protocol"], 1);
  EXPECT_EQ(hello["application"], "app");
  EXPECT_EQ(hello["file"], "/here/app.xml");
  EXPECT_EQ(hello["clock"], "real");
  EXPECT_EQ(hello["read_only"], true);
  EXPECT_EQ(hello["runnel"], "0.1.0");
  EXPECT_NE(hello["run"], "");
}

TEST_F(Viewing, TellsAllModuleTypesWithPortsAndParameters) {
  Start();
  const Json catalogue = View().Next("catalogue");
  std::vector<std::string> types;
  for (const Json& module : catalogue["modules"]) types.push_back(module["type"]);
  EXPECT_THAT(types, ElementsAre("test/counter", "test/failing", "test/fast_counter", "test/lists", "test/sink"));
  const Json& counter = catalogue["modules"][0];
  EXPECT_EQ(counter["summary"], "does it");
  EXPECT_EQ(counter["plugin"], "test");
  ASSERT_EQ(counter["ports"].size(), 1U);
  EXPECT_EQ(counter["ports"][0]["name"], "out");
  EXPECT_EQ(counter["ports"][0]["direction"], "output");
  EXPECT_EQ(counter["ports"][0]["type"], "int32");
  ASSERT_EQ(counter["parameters"].size(), 2U);
  EXPECT_EQ(counter["parameters"][0]["name"], "speed");
  EXPECT_EQ(counter["parameters"][0]["unit"], "m/s");
  EXPECT_EQ(counter["parameters"][0]["maximum"], 9);
  EXPECT_EQ(catalogue["modules"][4]["ports"][0]["required"], true);
  EXPECT_FALSE(catalogue["types"].empty());
}

TEST_F(Viewing, TellsTheWholeStructureParentsFirst) {
  Start();
  Viewer viewer = View();
  const Json structure = viewer.Next("structure");
  std::vector<std::string> seen{""};
  std::map<std::string, Json> by_path;
  for (const Json& element : structure["elements"]) {
    const std::string path = element["path"];
    const std::string parent = path.substr(0, path.rfind('/'));
    EXPECT_NE(std::find(seen.begin(), seen.end(), parent), seen.end()) << path;
    seen.push_back(path);
    by_path[path] = element;
  }
  const Json& port = by_path["/app/a/output/out"];
  const Json& parameter = by_path["/app/a/parameter/speed"];
  EXPECT_EQ(by_path["/app"]["kind"], "application");
  EXPECT_EQ(by_path["/app/a"]["thread"], "main");
  EXPECT_EQ(by_path["/app/a/parameter/title"]["settable"], false);
  EXPECT_EQ(by_path["/app/a/parameter/title"]["remakes"], true);
  EXPECT_EQ(by_path["/threads/main"]["period"], 0.001);
  EXPECT_EQ(port["kind"], "port");
  EXPECT_EQ(port["direction"], "output");
  EXPECT_EQ(port["data_type"], "int32");
  EXPECT_EQ(port["owner"], "/app/a");
  EXPECT_EQ(port["description"], "how many so far");
  EXPECT_EQ(parameter["value"], "1");
  EXPECT_EQ(parameter["minimum"], 0);
  EXPECT_EQ(parameter["maximum"], 9);
  EXPECT_EQ(parameter["unit"], "m/s");
  EXPECT_EQ(parameter["settable"], true);
  EXPECT_EQ(parameter["remakes"], false);
  ASSERT_EQ(structure["connections"].size(), 1U);
  EXPECT_EQ(structure["connections"][0]["from"], "/app/a/output/out");
  EXPECT_EQ(structure["connections"][0]["to"], "/app/b/input/in");
}

TEST_F(Viewing, ShowsNewValuesOfWatchedPorts) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "watch"}, {"path", "/app/a/output/out"}, {"rate", 60}});
  const Json first = viewer.Value("/app/a/output/out");
  const Json second = viewer.Value("/app/a/output/out");
  EXPECT_GT(second["value"], first["value"]);
  EXPECT_GT(second["count"], first["count"]);
  EXPECT_FALSE(first.contains("cut"));
  EXPECT_GT(first["bytes"], 0);
}

TEST_F(Viewing, TimesOfValuesCountFromTheStart) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "watch"}, {"path", "/app/a/output/out"}, {"rate", 60}});
  const Json values = viewer.Next("values");
  EXPECT_LE(values["items"][0]["stamp"], values["time"]);
  EXPECT_GT(values["items"][0]["stamp"], -1);  // it may have been published before the inspector
  EXPECT_LT(values["time"], 3600);
}

TEST_F(Viewing, TellsWhenAValueWasMeasuredIfItsPublisherSaysSo) {
  Start();
  auto& late = runtime.Create<Lagging>(**runtime.root().Find("/app"), "late");
  ASSERT_TRUE(runtime.MakeReady(late));
  Viewer viewer = View();
  viewer.Send({{"op", "watch"}, {"path", "/app/late/output/out"}, {"rate", 60}});
  const Json value = viewer.Value("/app/late/output/out");
  EXPECT_NEAR(double(value["stamp"]) - double(value["measured"]), 0.25, 1e-6);
  viewer.Send({{"op", "watch"}, {"path", "/app/a/output/out"}, {"rate", 60}});
  EXPECT_FALSE(viewer.Value("/app/a/output/out").contains("measured"));
}

TEST_F(Viewing, ShowsWhatAnInputGets) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "watch"}, {"path", "/app/b/input/in"}, {"rate", 60}});
  EXPECT_GT(viewer.Value("/app/b/input/in")["value"], 0);
}

TEST_F(Viewing, CutsListsAsTheViewerWantsThem) {
  Start();
  Apply("create /app/lists test/lists");
  Viewer viewer = View();
  viewer.Send({{"op", "watch"}, {"path", "/app/lists/output/list"}, {"rate", 60}, {"elements", 3}});
  const Json cut = viewer.Value("/app/lists/output/list");
  EXPECT_EQ(cut["value"], Json({0.5, 0.5, 0.5}));
  EXPECT_EQ(cut["cut"], true);
  viewer.Send({{"op", "watch"}, {"path", "/app/lists/output/list"}, {"rate", 60}, {"elements", 5000}});
  for (;;) {
    const Json whole = viewer.Value("/app/lists/output/list");
    if (whole.contains("cut")) continue;  // it was on its way
    EXPECT_EQ(whole["value"].size(), 1000U);
    break;
  }
}

TEST_F(Viewing, WatchesPathsBeforeTheyLeadAnywhereAndAfterTheyHave) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "watch"}, {"path", "/app/late/output/out"}, {"rate", 60}});
  viewer.Next("structure");
  Apply("create /app/late test/counter");
  EXPECT_GT(viewer.Value("/app/late/output/out")["value"], 0);
  Apply("delete /app/late; create /app/late test/counter");
  EXPECT_GT(viewer.Value("/app/late/output/out")["value"], 0);
}

TEST_F(Viewing, MeasuresPublicationsAndThreads) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "watch_rates"}, {"rate", 10}});
  Json rates = viewer.Next("rates");
  while (rates["ports"].value("/app/a/output/out", 0.0) <= 0) rates = viewer.Next("rates");
  EXPECT_FALSE(rates["ports"].contains("/app/b/input/in"));
  const Json& thread = rates["threads"]["/threads/main"];
  EXPECT_GT(thread["cycles"], 0);
  EXPECT_GT(thread["duration_ms"]["max"], 0);
}

TEST_F(SimulatedViewing, RatesCountByTheApplicationsClock) {
  Start();
  Viewer viewer = View();
  viewer.Next("structure");
  viewer.Send({{"op", "watch_rates"}, {"rate", 10}});
  std::atomic<bool> is_over{false};
  std::thread running([&] {
    for (int i = 1; !is_over; ++i) scheduler.RunUntil(Time(i * 100ms));
  });
  // The first ones may span time before the run, too.
  double rate = 0;
  for (int told = 0; told < 20 && std::abs(rate - 1000) > 5; ++told) {
    rate = viewer.Next("rates")["ports"]["/app/a/output/out"].get<double>();
  }
  is_over = true;
  running.join();
  EXPECT_NEAR(rate, 1000, 5);
}

TEST_F(SimulatedViewing, RatesFallToNothingWhenNothingIsPublished) {
  Start();
  scheduler.RunUntil(Time(100ms));
  Viewer viewer = View();
  viewer.Next("structure");
  viewer.Send({{"op", "watch_rates"}, {"rate", 10}});
  EXPECT_EQ(viewer.Next("rates")["ports"]["/app/a/output/out"], 0);
}

TEST_F(SimulatedViewing, TellsTimePaceAndWhatCanBeUndone) {
  Start();
  Viewer viewer = View();
  Json state = viewer.Next("state");
  EXPECT_EQ(state["time"], 0);
  EXPECT_EQ(state["paused"], false);
  EXPECT_EQ(state["speed"], 0);
  EXPECT_EQ(state["undo"], nullptr);
  EXPECT_EQ(state["ended"], false);
  scheduler.RunUntil(Time(2500ms));
  EXPECT_EQ(View().Next("state")["time"], 2.5);
  EXPECT_EQ(viewer.Change({"set /app/a/speed 2"})["ok"], true);
  EXPECT_THAT(View().Next("state")["undo"], HasSubstr("set /app/a/speed 2"));
}

TEST_F(SimulatedViewing, TellsTheEndAndItsVerdict) {
  Start();
  Viewer viewer = View();
  EXPECT_EQ(viewer.Next("state")["verdict"], nullptr);
  inspector->NoteEnd("reached: 3 m\n");
  const Json state = viewer.Next("state");
  EXPECT_EQ(state["ended"], true);
  EXPECT_EQ(state["verdict"], "reached: 3 m\n");
  EXPECT_EQ(View().Next("state")["ended"], true);
}

TEST_F(Viewing, TellsTheLogFromItsNewestEntriesOn) {
  Start();
  for (int i = 0; i < 600; ++i) log.Add(ApplicationLog::Kind::kWarning, "old " + std::to_string(i));
  Viewer viewer = View();
  const Json before = viewer.Next("log");
  ASSERT_EQ(before["entries"].size(), 500U);
  EXPECT_EQ(before["entries"][0]["text"], "old 100");
  EXPECT_EQ(before["entries"][0]["number"], 100);
  log.Add(ApplicationLog::Kind::kFault, "\"new\"\nand \xff");
  const Json after = viewer.Next("log");
  ASSERT_EQ(after["entries"].size(), 1U);
  EXPECT_EQ(after["entries"][0]["kind"], "fault");
  EXPECT_EQ(after["entries"][0]["text"], "\"new\"\nand \xef\xbf\xbd");
}

TEST_F(SimulatedViewing, ShowsWhichModulesHaveBeenStoppedAndWhy) {
  Start();
  Apply("create /app/broken test/failing");
  Viewer viewer = View();
  EXPECT_EQ(viewer.Element("/app/broken")["failure"], nullptr);
  scheduler.RunUntil(Time(10ms));
  for (const Fault& fault : scheduler.TakeFaults()) {
    log.Add(ApplicationLog::Kind::kFault, "a text", fault.path, fault.message);
  }
  log.Add(ApplicationLog::Kind::kFault, "replaced by the supervisor", "/app/a", "");
  EXPECT_EQ(viewer.Element("/app/broken")["failure"], "is worn out");
  EXPECT_EQ(View().Next("state")["faults"], 2);
  EXPECT_EQ(View().Element("/app/broken")["failure"], "is worn out");
  EXPECT_EQ(View().Element("/app/a")["failure"], nullptr);
  Apply("replace /app/broken with test/counter");
  EXPECT_EQ(viewer.Element("/app/broken")["failure"], nullptr);
}

TEST_F(Viewing, ShowsWhichModuleIsStuckUntilItReturns) {
  Register<Hanging>("test/hanging");
  Start();
  Apply("create /app/hang test/hanging");
  ASSERT_TRUE(scheduler.SetStuckLimit("/app/hang", 200ms));
  Viewer viewer = View();
  EXPECT_EQ(viewer.Element("/app/hang")["failure"], nullptr);
  const auto is_told = [&] {  // as an application tells it
    const auto faults = scheduler.TakeFaults();
    for (const Fault& fault : faults) {
      log.Add(ApplicationLog::Kind::kFault, "a text", fault.path, fault.is_mended ? "" : fault.message);
    }
    return !faults.empty();
  };
  Hanging::hangs = true;
  WaitUntil("it is stuck", is_told);
  const Json stuck = viewer.Element("/app/hang");
  EXPECT_EQ(stuck.value("stuck", false), true);
  EXPECT_THAT(stuck.dump(), HasSubstr("has not returned from its cycle for "));
  Hanging::hangs = false;
  WaitUntil("it has returned", is_told);
  const Json returned = viewer.Element("/app/hang");
  EXPECT_EQ(returned["failure"], nullptr);
  EXPECT_FALSE(returned.contains("stuck"));
}

}  // namespace

}  // namespace runnel::test
