#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/module/module.h"
#include "core/module/sense_control_module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/tracing/trace_recorder.h"

namespace runnel::test {

using namespace std::chrono_literals;
using nlohmann::json;
using ClockKind = SchedulerOptions::ClockKind;

class Ticker final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};
  Output<int> seldom{this, "seldom"};
  int updates = 0;

 private:
  void Update() override {
    out.Publish(++updates);
    if (updates % 4 == 0) seldom.Publish(updates), seldom.Publish(-updates);
  }
};

class Listener final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in", {.trigger = true}};
  int updates = 0;

 private:
  void Update() override {
    (void)in.Read();
    ++updates;
  }
};

class Drive final : public SenseControlModule {
 public:
  using SenseControlModule::SenseControlModule;
  Output<int> seen{sensor_outputs(), "seen"};

 private:
  void Sense() override { seen.Publish(1); }
  void Control() override {}
};

inline const std::string kLongMessage = "is worn \"out\", " + std::string(100, 'x') + " and that is all";

class Faulty final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override { throw std::runtime_error(kLongMessage); }
};

class Traced : public ::testing::Test {
 protected:
  ~Traced() override {
    scheduler.reset();
    recorder.reset();
    std::filesystem::remove(path);
  }

  void Begin(ClockKind clock, std::size_t capacity = 65'536, Duration interval = 1ms) {
    auto started = TraceRecorder::Start(runtime, {.file = path,
                                                  .application = "test",
                                                  .is_simulated = clock == ClockKind::kSimulated,
                                                  .capacity = capacity,
                                                  .interval = interval});
    ASSERT_TRUE(started) << started.error().ToString();
    recorder = std::move(*started);
    scheduler.emplace(runtime, SchedulerOptions{.clock = clock, .tracer = recorder.get()});
  }
  template <typename M>
  M& Make(const std::string& name) {
    return runtime.Create<M>(runtime.root(), name);
  }
  void Ready() { ASSERT_TRUE(runtime.MakeReady(runtime.root())); }
  void Finish() {
    scheduler->Stop();
    const auto finished = recorder->Finish();
    ASSERT_TRUE(finished) << finished.error().ToString();
    summary = *finished;
    std::ifstream stream(path);
    events = json::parse(stream);
    ASSERT_EQ(events.size(), summary.events);
  }

  /// The track of a thread container.
  int TrackOf(const std::string& name) {
    for (const json& each : events) {
      if (each["name"] == "thread_name" && each["args"]["name"] == name) return each["tid"];
    }
    ADD_FAILURE() << "no track " << name;
    return -1;
  }
  std::vector<json> EventsOf(const std::string& category, const std::string& name = {}) {
    std::vector<json> found;
    for (const json& each : events) {
      if (each.value("cat", "") == category && (name.empty() || each["name"] == name)) {
        found.push_back(each);
      }
    }
    return found;
  }
  std::uint64_t Values(const std::string& port) {
    std::uint64_t values = 0;
    for (const json& each : EventsOf("publish", "publish " + port)) {
      values += each["args"]["values"].get<std::uint64_t>();
    }
    return values;
  }
  // In whole nanoseconds, so that sums are exact.
  static std::int64_t Begin(const json& event) { return std::llround(event["ts"].get<double>() * 1e3); }
  static std::int64_t End(const json& event) { return Begin(event) + std::llround(event.value("dur", 0.0) * 1e3); }
  /// Whatever is on one track lies within one another or apart, and each of `inner` in one of `outer`.
  void ExpectWithin(const std::vector<json>& inner, const std::vector<json>& outer) {
    std::map<int, std::map<std::int64_t, std::int64_t>> ends;  // by track, then by their begin
    for (const json& each : outer) ends[each["tid"].get<int>()][Begin(each)] = End(each);
    for (const json& each : inner) {
      const auto& track = ends[each["tid"].get<int>()];
      const auto after = track.upper_bound(Begin(each));
      ASSERT_NE(after, track.begin()) << each;
      EXPECT_LE(End(each), std::prev(after)->second) << each;
    }
  }
  void ExpectOneAfterTheOther(const std::vector<json>& slices) {
    std::map<int, std::int64_t> ends;
    for (const json& each : slices) {
      EXPECT_LE(ends[each["tid"].get<int>()], Begin(each)) << each;
      ends[each["tid"].get<int>()] = End(each);
    }
  }

  const std::string path =
      ::testing::TempDir() + ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".json";
  Runtime runtime;
  std::unique_ptr<TraceRecorder> recorder;
  std::optional<Scheduler> scheduler;
  TraceSummary summary;
  json events;
};

}  // namespace runnel::test
