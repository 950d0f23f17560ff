// A recording begins or leaves nothing behind, and one that fails leaves the application alone, wherever memory runs
// out.

#include <atomic>
#include <memory>
#include <new>
#include <optional>

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/recording/recording_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;

// The thread that writes the first value meets a failing allocation so much later; 0: it does not.
std::atomic<std::size_t> writer_fails_at{0};

/// Its text format is asked for by the recorder's thread.
struct Spy {
  int number = 0;
};
inline void Describe(TypeBuilder<Spy>& type) {
  type.Name("test::Spy")
      .Leaf({[](const void* at) -> std::string {
               thread_local std::optional<FaultInjection> injection;
               if (const std::size_t nth = writer_fails_at.exchange(0); nth > 0) {
                 injection.emplace(InjectedFault::kAllocation, nth);
               }
               return std::to_string(static_cast<const Spy*>(at)->number);
             },
             [](std::string_view, void*) -> Result<void> { return {}; }, true});
}

class SpySource final : public Module {
 public:
  using Module::Module;
  Output<Spy> out{this, "out"};

 private:
  void Update() override { out.Publish(Spy{++count_}); }
  int count_ = 0;
};

using RecordingFaults = RecordingTest;

TEST_F(RecordingFaults, ARecordingBeginsOrLeavesNothingBehind) {
  const std::string file = Path("a.mcap");
  auto application = std::make_unique<Application>();
  std::unique_ptr<Recorder> recorder;
  const RecorderOptions options{
      .file = file, .ports = {"**"}, .about = {.name = "the name of an application", .text = "<a/>"}};
  RecorderOptions given = options;
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          auto started = Recorder::Start(application->runtime, &application->scheduler, std::move(given));
          if (started) recorder = std::move(*started);
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool has_struck) {
        given = options;
        const bool has_begun = recorder != nullptr;
        ASSERT_TRUE(has_begun || has_struck);
        if (has_begun) {
          application->Run(milliseconds(50));
          Must(recorder->Finish());
          ASSERT_EQ(ValuesOf(file, "/source/output/number").size(), 5u);
          recorder.reset();
        }
        // Readers of the application's own are all that is connected.
        ASSERT_EQ(application->source->number.outgoing().size(), 1u);
        ASSERT_TRUE(application->sink->sum.outgoing().empty());
        ASSERT_EQ(std::filesystem::remove(file), has_begun);
        application->Run(milliseconds(20));
        application = std::make_unique<Application>();
      });
  EXPECT_GT(points, 50u);
}

TEST_F(RecordingFaults, OneThatEndsWithoutMemoryLetsTheApplicationGo) {
  const std::string file = Path("a.mcap");
  std::unique_ptr<Application> application;
  std::unique_ptr<Recorder> recorder;
  const auto begin = [&] {
    application = std::make_unique<Application>();
    recorder = Must(Recorder::Start(application->runtime, &application->scheduler, {.file = file}));
    application->Run(milliseconds(50));
  };
  begin();
  AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          (void)recorder->Finish();
        } catch (const std::bad_alloc&) {
        }
        recorder.reset();
      },
      [&](bool) {
        ASSERT_EQ(application->source->number.outgoing().size(), 1u);
        application->Run(milliseconds(20));
        ASSERT_EQ(ValuesOf(file, "/source/output/number").size(), 5u);
        std::filesystem::remove(file);
        begin();
      });
}

TEST_F(RecordingFaults, OneThatCannotTakeUpANewPortHasAllThatCameUntilThenAndAnEnd) {
  std::unique_ptr<Application> application;
  std::unique_ptr<Recorder> recorder;
  int failures = 0;
  const auto begin = [&] {
    std::filesystem::remove(Path("a.mcap"));
    application = std::make_unique<Application>();
    recorder = Must(Recorder::Start(application->runtime, &application->scheduler, {.file = Path("a.mcap")}));
    application->Run(milliseconds(50));
    WaitUntil("all has been taken", [&] { return recorder->status().values == 15; });
  };
  begin();
  AtEachPoint(
      InjectedFault::kAllocation,
      [&] {
        try {
          auto& late = application->runtime.Create<Source>(application->runtime.root(), "late");
          (void)application->runtime.MakeReady(late);
        } catch (const std::bad_alloc&) {
        }
      },
      [&](bool) {
        failures += !recorder->Finish();
        ASSERT_EQ(ValuesOf(Path("a.mcap"), "/source/output/number").size(), 5u);
        ASSERT_EQ(recorder->status().values, 15u) << "of three ports";
        ASSERT_TRUE(Must(McapReader::Open(Path("a.mcap")))->contents().ended_properly);
        recorder.reset();
        begin();
      });
  EXPECT_GT(failures, 5);
}

TEST_F(RecordingFaults, OneThatCannotWriteOnLetsTheApplicationGoOn) {
  bool fails = true;
  int failures = 0;
  for (std::size_t nth = 1; fails; ++nth) {
    SCOPED_TRACE(nth);
    const std::string file = Path(std::to_string(nth) + ".mcap");
    Runtime runtime;
    Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
    CreateThread(runtime, "main", {.period = milliseconds(10)});
    auto& source = runtime.Create<SpySource>(runtime.root(), "source");
    Must(runtime.MakeReady(runtime.root()));
    auto recorder = Must(Recorder::Start(runtime, &scheduler, {.file = file}));
    writer_fails_at = nth;
    ASSERT_TRUE(scheduler.RunUntil(runtime.clock().Now() + milliseconds(100)));
    const auto finished = recorder->Finish();
    fails = recorder->TakeFailure().has_value();  // of a value, too, which is left out
    failures += fails;
    ASSERT_TRUE(finished || fails);
    const RecordingStatus status = recorder->status();
    recorder.reset();
    ASSERT_TRUE(source.out.outgoing().empty());
    ASSERT_EQ(source.out.publications(), 10u);
    const auto values = ValuesOf(file, "/source/output/out");
    ASSERT_LE(values.size(), 10u);
    ASSERT_EQ(status.values, values.size());
    if (!fails) {
      ASSERT_EQ(values.size(), 10u);
    }
  }
  EXPECT_GT(failures, 5);
}

}  // namespace
}  // namespace runnel::test
