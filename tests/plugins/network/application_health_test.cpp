// What /diagnostics says of an application: of what is there, and by who knows.
#include "plugins/network/application_health.h"

#include <stdexcept>

#include <gmock/gmock.h>

#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/supervision/supervisor.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class BrokenLamp final : public Module {
 public:
  using Module::Module;
  Input<double> level{this, "level"};

 private:
  void Update() override { throw std::runtime_error("the wire is through"); }
};

class SilentDimmer final : public Module {
 public:
  using Module::Module;
  Output<double> level{this, "level"};

 private:
  void Update() override {}
};

class ApplicationHealthTest : public testing::Test {
 protected:
  void Fail() {
    (void)scheduler_.Step();
    for (const Fault& each : scheduler_.TakeFaults()) {
      log_.Add(ApplicationLog::Kind::kFault, each.path + ": " + each.message, each.path, each.message);
    }
  }
  // As it is when it is next looked at.
  std::string Text() {
    std::string text;
    ApplicationHealth anew = health_;
    for (const RosDiagnosticStatus& each : anew()) {
      text += std::to_string(static_cast<int>(each.level)) + " " + each.name + ": " + each.message + "\n";
    }
    return text;
  }

  Runtime runtime_;
  ThreadContainer& thread_ = CreateThread(runtime_, "control", {.period = std::chrono::milliseconds(10)});
  Group& group_ = runtime_.Create<Group>(runtime_.root(), "house");
  SilentDimmer& dimmer_ = runtime_.Create<SilentDimmer>(group_, "dimmer");
  BrokenLamp& lamp_ = runtime_.Create<BrokenLamp>(group_, "lamp");
  Scheduler scheduler_{runtime_, {.clock = SchedulerOptions::ClockKind::kSimulated}};
  Supervisor supervisor_{runtime_, scheduler_, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); }};
  ApplicationLog log_{runtime_.clock()};
  const ApplicationHealth health_{group_, scheduler_, supervisor_, log_};
};

TEST_F(ApplicationHealthTest, WhoHasFailedIsSoWhateverItSaysAndUntilItGoes) {
  ASSERT_TRUE(runtime_.MakeReady(runtime_.root()));
  EXPECT_THAT(Text(), HasSubstr("0 house: modules: no fault"));
  Fail();
  const auto has_failed =
      AllOf(HasSubstr("2 house: modules: 1 failed"), HasSubstr("2 house: /house/lamp: the wire is through"));
  EXPECT_THAT(Text(), has_failed);
  log_.Add(LogMessage{.level = LogLevel::kWarning, .path = lamp_.path(), .text = "it is cold"});
  EXPECT_THAT(Text(), has_failed);
  ASSERT_TRUE(runtime_.Delete(lamp_));
  EXPECT_THAT(Text(), HasSubstr("0 house: modules: no fault"));
}

// Whatever others say in the log, and as long as the input is there: also when it has come back.
TEST_F(ApplicationHealthTest, SupervisionSaysWhichInputsHearNothing) {
  ASSERT_TRUE(Port::Connect(dimmer_.level, lamp_.level));
  ASSERT_TRUE(runtime_.MakeReady(runtime_.root()));
  const std::string input = lamp_.level.path();
  ASSERT_TRUE(supervisor_.Add(SupervisionRule{.of = input, .after = std::chrono::milliseconds(30)}));
  log_.Add(ApplicationLog::Kind::kFault, "house.xml:3:1: " + input + ": nothing new for 3 s");
  EXPECT_THAT(Text(), Not(HasSubstr("nothing new")));
  ASSERT_TRUE(scheduler_.RunUntil(runtime_.clock().Now() + std::chrono::seconds(1)));
  const std::string is_silent = "3 house: " + input + ": nothing new for ";
  EXPECT_THAT(Text(), HasSubstr(is_silent));
  ASSERT_TRUE(runtime_.Delete(lamp_));
  EXPECT_THAT(Text(), Not(HasSubstr("nothing new")));
  ASSERT_TRUE(runtime_.MakeReady(runtime_.Create<BrokenLamp>(group_, "lamp")));
  EXPECT_THAT(Text(), HasSubstr(is_silent));
}

}  // namespace
}  // namespace runnel::test
