// The terminal knows every request of the table, and asks the table by which of them something may move.

#include "plugins/command_service/request_table.h"

#include "core/base/clock.h"
#include "tests/plugins/control/control_fixture.h"

namespace runnel::test {
namespace {

using ::testing::Not;

// With what is required, in the order of the table.
std::string WordsOf(const DescribedRequest& each) {
  if (each.name == "change") return "change\nconnect /a/out /b/in";
  if (each.name == "call") return "call /a/out";
  if (each.name == "log") return "log level=debug";
  std::string words(each.name);
  for (const RequestField& field : each.fields) {
    if (!field.is_required) continue;
    words += field.name == "path" ? (each.role == "drive" ? " /b/in" : " /app/a") : " 1";
  }
  return words;
}

class RequestsOfTerminals : public ControlTest {
 protected:
  std::string AskAsOf(Time asked, const std::string& request) {
    const int client = RawClient();
    SendAll(client,
            FrameBytes("at", std::to_string(asked.time_since_epoch().count())) + FrameBytes("request", request));
    std::string answer = ReadAll(client, "end ");
    close(client);
    return answer;
  }
};

TEST_F(RequestsOfTerminals, AreThoseOfTheTable) {
  const Time before = SteadyClock().Now();
  runtime.robot_stop().Press("the test");
  for (const DescribedRequest& each : RequestTable()) {
    if (each.name == "set") continue;  // a terminal sends it as a change
    const std::string answer = AskAsOf(before, WordsOf(each));
    EXPECT_THAT(answer, HasSubstr("end ")) << each.name;
    EXPECT_THAT(answer, Not(HasSubstr("there is no command"))) << each.name;
    const bool is_late = answer.find("STOP was pressed or released after this was asked for") != std::string::npos;
    EXPECT_EQ(is_late, each.lets_move) << each.name << ": " << answer;
  }
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

}  // namespace
}  // namespace runnel::test
