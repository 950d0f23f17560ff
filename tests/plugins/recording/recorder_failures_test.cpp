// What ends a recording, and never the application.
#include "tests/plugins/recording/recording_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

/// Its text format throws an int from the third value on.
struct Moody {
  int number = 0;
};
inline void Describe(TypeBuilder<Moody>& type) {
  type.Name("test::Moody")
      .Leaf({[](const void* at) -> std::string {
               const int number = static_cast<const Moody*>(at)->number;
               if (number >= 3) throw number;
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

TEST_F(RecorderFailures, ATypeWhoseTextFormatThrowsEndsTheRecordingAndNotTheProcess) {
  Runtime runtime;
  Scheduler scheduler(runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  CreateThread(runtime, "main", {.period = milliseconds(10)});
  auto& source = runtime.Create<MoodySource>(runtime.root(), "source");
  Must(runtime.MakeReady(runtime.root()));
  auto recorder = Must(Recorder::Start(runtime, &scheduler, {.file = Path("a.mcap")}));
  scheduler.RunUntil(runtime.clock().Now() + milliseconds(100));
  std::optional<Error> failure;
  WaitUntil("the recording has failed", [&] {
    failure = recorder->TakeFailure();
    return failure.has_value();
  });
  EXPECT_THAT(failure->message, HasSubstr("exception of type int"));
  EXPECT_EQ(failure->path, "/source/output/mood");
  EXPECT_FALSE(recorder->Finish());
  // The application has gone on, and nothing of the recorder is left in it.
  EXPECT_EQ(source.mood.publications(), 10u);
  EXPECT_TRUE(source.mood.outgoing().empty());
}

}  // namespace
}  // namespace runnel::test
