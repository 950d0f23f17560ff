// What a recording lacks or is ended by, and never the application.
#include "tests/plugins/recording/recording_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

/// Its text format throws an int for each third value.
struct Moody {
  int number = 0;
};
inline void Describe(TypeBuilder<Moody>& type) {
  type.Name("test::Moody")
      .Leaf({[](const void* at) -> std::string {
               const int number = static_cast<const Moody*>(at)->number;
               if (number % 3 == 0) throw number;
               return std::to_string(number);
             },
             [](std::string_view, void*) -> Result<void> { return {}; }, true});
}

class MoodySource final : public Module {
 public:
  using Module::Module;
  Output<Moody> mood{this, "mood"};

 private:
  void Update() override { mood.Publish(Moody{++count_}); }
  int count_ = 0;
};

using RecorderFailures = RecordingTest;

TEST_F(RecorderFailures, AValueWhoseTextFormatThrowsIsLeftOutAndCountedAndToldOnce) {
  Runtime runtime;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  CreateThread(runtime, "main", {.period = milliseconds(10)});
  auto& moody = runtime.Create<MoodySource>(runtime.root(), "source");
  runtime.Create<Source>(runtime.root(), "other");
  Must(runtime.MakeReady(runtime.root()));
  auto recorder = Must(Recorder::Start(runtime, &scheduler, {.file = Path("a.mcap"), .ports = {"mood", "number"}}));
  scheduler.RunUntil(runtime.clock().Now() + milliseconds(100));
  std::optional<Error> failure;
  WaitUntil("the value is told", [&] {
    failure = recorder->TakeFailure();
    return failure.has_value();
  });
  EXPECT_THAT(failure->message, HasSubstr("exception of type int"));
  EXPECT_EQ(failure->path, "/source/output/mood");
  EXPECT_TRUE(recorder->Finish());
  EXPECT_FALSE(recorder->TakeFailure());
  EXPECT_EQ(recorder->status().values, 17u);
  EXPECT_EQ(recorder->status().dropped, 3u);
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/source/output/mood"), testing::SizeIs(7));
  EXPECT_THAT(ValuesOf(Path("a.mcap"), "/other/output/number"), testing::SizeIs(10));
  EXPECT_TRUE(Must(McapReader::Open(Path("a.mcap")))->contents().ended_properly);
  EXPECT_EQ(moody.mood.publications(), 10u);
  EXPECT_TRUE(moody.mood.outgoing().empty()) << "nothing of the recorder is left in the application";
}

}  // namespace
}  // namespace runnel::test
