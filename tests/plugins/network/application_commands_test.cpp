// What one application has another one do: not when it comes so late that nobody waits for it any more.

#include "plugins/network/application_commands.h"

#include <thread>

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/parameters/parameter.h"
#include "plugins/ros_messages/names.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using ::testing::HasSubstr;

class Planner final : public Module {
 public:
  using Module::Module;
  Parameter<double> speed{this, "speed", {.default_value = 1}};

 private:
  void Update() override {}
};

/// An application that has others do something, or does it.
class Commanded {
 public:
  Commanded(WireEngine& engine, const std::string& name, std::vector<std::string> allowed) : member(engine, name) {
    member.Allow(std::move(allowed));
    member.Begin();
    commands = ApplicationCommands::Start(member.link(), *member.network, service);
  }

  Member member;
  Planner& planner = member.runtime.Create<Planner>(member.group, "planner");
  ModuleRegistry modules;
  StructureEditor editor{member.runtime, modules, nullptr};
  ApplicationLog log{member.runtime.clock()};
  CommandService service{{member.runtime, modules, editor, log}};
  std::unique_ptr<ApplicationCommands> commands;
};

struct Answer {
  bool is_done = false;
  std::string said;
  std::string token;
};

/// Says to the robot what nobody has to wait for.
class RawAsker {
 public:
  RawAsker(Commanded& from, Commanded& robot)
      : id(fmt::format("{:02x}", fmt::join(robot.member.link().participant().id(), ""))),
        endpoints_(Must(ServiceEndpoints::Start(ServiceEndpoints::Side::kClient,
                                                {.service = "/robot/runnel_commands",
                                                 .request = {DdsType("runnel_msgs/srv/Command_Request")},
                                                 .response = {DdsType("runnel_msgs/srv/Command_Response")},
                                                 .depth = 32,
                                                 .is_latched = true},
                                                from.member.link().participant(), 77, [] {}))) {}

  Answer Ask(const std::string& change, const std::string& whom) {
    Send(change, whom);
    return Receive();
  }
  void Send(const std::string& change, const std::string& whom) {
    Octets octets;
    CdrWriter to(octets);
    for (const std::string& each : {std::string("//planner"), change, whom}) to.PutText(each);
    EXPECT_TRUE(endpoints_->Request(octets));
  }
  Answer AskHalf(const std::string& change) {
    Octets octets;
    CdrWriter to(octets);
    for (const std::string& each : {std::string("//planner"), change}) to.PutText(each);
    EXPECT_TRUE(endpoints_->Request(octets));
    return Receive();
  }
  Answer Receive() {
    std::optional<ServiceMessage> reply;
    WaitUntil("it answers", [&] { return (reply = endpoints_->Take()).has_value(); });
    Answer answer;
    auto from = CdrReader::Begin(reply->message);
    EXPECT_TRUE(from && from->Get(answer.is_done) && from->GetText(answer.said));
    (void)from->GetText(answer.token);
    return answer;
  }

  const std::string id;

 private:
  std::unique_ptr<ServiceEndpoints> endpoints_;
};

class ApplicationCommandsTest : public ::testing::Test {
 protected:
  const std::shared_ptr<WireEngine> engine = MakeFakeWire();
  Commanded robot{*engine, "robot", {"set"}};
  Commanded planner{*engine, "planner", {}};
};

TEST_F(ApplicationCommandsTest, WhatAnotherApplicationAsksForIsDone) {
  std::shared_ptr<void> asking;
  std::optional<std::string> said;
  WaitUntil("it is done", [&] {
    const std::lock_guard lock(planner.member.runtime.structure_mutex());
    const auto answer = planner.commands->Ask("set //robot/planner/speed 0.3", asking);
    if (answer) said = *answer;
    return said.has_value();
  });
  EXPECT_EQ(robot.planner.speed.Get(), 0.3);
  EXPECT_THAT(*said, HasSubstr("robot: "));
}

// It may have lain in the socket of a robot that stood still, and whoever has sent it does not wait for it any more.
TEST_F(ApplicationCommandsTest, NothingIsDoneWithoutATokenThatHasJustBeenGiven) {
  RawAsker asker(planner, robot);
  const Answer given = asker.Ask("set /planner/speed 2", asker.id);
  EXPECT_FALSE(given.is_done);
  EXPECT_EQ(robot.planner.speed.Get(), 1);
  ASSERT_THAT(given.token, ::testing::StartsWith(asker.id + ":"));
  const std::int64_t at = std::stoll(given.token.substr(asker.id.size() + 1));
  const auto with = [&](std::int64_t time) {
    return asker.Ask("set /planner/speed 3", asker.id + ":" + std::to_string(time));
  };
  for (const std::int64_t other : {at - 5'000'000'000, at + 3'600'000'000'000, std::int64_t{0}, INT64_MIN, INT64_MAX}) {
    const Answer late = with(other);
    EXPECT_FALSE(late.is_done) << other;
    EXPECT_EQ(late.token, "") << other;
    EXPECT_THAT(late.said, HasSubstr("it came too late: nothing has been done")) << other;
  }
  EXPECT_EQ(robot.planner.speed.Get(), 1);
  EXPECT_TRUE(with(at).is_done);
  EXPECT_EQ(robot.planner.speed.Get(), 3);
}

// Whoever asked waited in vain.
TEST_F(ApplicationCommandsTest, WhatIsCutShortIsAnsweredAndNotDone) {
  RawAsker asker(planner, robot);
  const Answer answer = asker.AskHalf("set /planner/speed 2");
  EXPECT_FALSE(answer.is_done);
  EXPECT_THAT(answer.said, HasSubstr("the request cannot be read: nothing has been done"));
  EXPECT_EQ(robot.planner.speed.Get(), 1);
}

TEST_F(ApplicationCommandsTest, NothingIsDoneThatWasAskedForBeforeAStopOfTheRobot) {
  RawAsker asker(planner, robot);
  const std::string token = asker.Ask("set /planner/speed 2", asker.id).token;
  RobotStop& stop = robot.member.runtime.robot_stop();
  stop.Press("a test");
  EXPECT_TRUE(stop.Release("a test"));
  const Answer late = asker.Ask("set /planner/speed 2", token);
  EXPECT_FALSE(late.is_done);
  EXPECT_THAT(late.said, HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_EQ(robot.planner.speed.Get(), 1);
  EXPECT_TRUE(asker.Ask("set /planner/speed 2", asker.Ask("set /planner/speed 2", asker.id).token).is_done);
}

// As while the link is down: it is not as of the token, which is given when it comes.
TEST_F(ApplicationCommandsTest, NoTokenIsGivenForWhatWasSentBeforeAStop) {
  RawAsker asker(planner, robot);
  SetCutOff(*engine, "planner", true);
  asker.Send("set /planner/speed 2", asker.id);
  RobotStop& stop = robot.member.runtime.robot_stop();
  stop.Press("a test");
  EXPECT_TRUE(stop.Release("a test"));
  std::this_thread::sleep_for(2 * WriterClock::kMostOfNetworks);  // sooner it may be as the network takes
  SetCutOff(*engine, "planner", false);
  const Answer late = asker.Receive();
  EXPECT_EQ(late.token, "");
  EXPECT_THAT(late.said, HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_TRUE(asker.Ask("set /planner/speed 2", asker.Ask("set /planner/speed 2", asker.id).token).is_done);
}

}  // namespace
}  // namespace runnel::test
