// The inspector as users of the program meet it.

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "plugins/web_server/web_server.h"
#include "tests/integration/program.h"
#include "tests/plugins/web_server/raw_client.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kUndrawnDemo = std::string(RUNNEL_XML) + "/apps/bug_demo.xml picture=";

// The one in what the program has printed.
std::uint16_t PortIn(const std::string& text) {
  const std::string before = "inspector: http://127.0.0.1:";
  const std::size_t found = text.find(before);
  if (found == std::string::npos) return 0;
  return static_cast<std::uint16_t>(std::stoul(text.substr(found + before.size())));
}

std::uint16_t FreePort() {
  const auto probe = WebServer::Start({.port = 0}, {}, {});
  EXPECT_TRUE(probe);
  return (*probe)->port();
}

class Inspect : public testing::Test {
 protected:
  std::string Write(const std::string& inspector) {
    std::ifstream demo(RUNNEL_XML "/apps/bug_demo.xml");
    std::string text{std::istreambuf_iterator<char>(demo), {}};
    text.insert(text.find("  <clock"), "  " + inspector + "\n");
    std::ofstream(file_) << text;
    return file_.string() + " picture= world=" RUNNEL_XML "/worlds/rooms.xml";
  }
  void TearDown() override { std::filesystem::remove(file_); }

  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("inspect_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".xml");
};

TEST_F(Inspect, ShowsThePageAndTalksWhileItRuns) {
  Program program("run --speed 1 --inspect=0 " + kUndrawnDemo);
  ASSERT_TRUE(program.WaitFor("inspector: http://127.0.0.1:"));
  ASSERT_TRUE(program.WaitFor("to the goal"));
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_NE(PortIn(ended.text), 0) << ended.text;
}

TEST_F(Inspect, TheEndCanStillBeSeenIfTheProgramIsHeld) {
  Program program("run --fast --hold --inspect=0 " + kUndrawnDemo);
  ASSERT_TRUE(program.WaitFor("held for viewers; Ctrl-C ends it"));
  program.WaitUntilHandles(SIGINT, true);
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("reached: path "));
}

TEST_F(Inspect, AVerdictIsSentToViewers) {
  // A fixed port, so that the test knows it before the program says it; free a moment ago.
  const std::uint16_t port = FreePort();
  Program program("run --fast --hold --inspect=" + std::to_string(port) + " " + kUndrawnDemo);
  ASSERT_TRUE(program.WaitFor("held for viewers"));
  RawClient page(port);
  EXPECT_THAT(page.Get("/"), AllOf(HasSubstr("200 OK"), HasSubstr("<html")));
  RawClient viewer(port);
  ASSERT_THAT(viewer.Upgrade("runnel.inspector.v1"), HasSubstr("101 "));
  for (;;) {
    const auto message = viewer.Receive(1);
    ASSERT_TRUE(message);
    if (message->payload.find("\"op\":\"state\"") == std::string::npos) continue;
    EXPECT_THAT(message->payload, HasSubstr("\"ended\":true"));
    EXPECT_THAT(message->payload, HasSubstr("\"verdict\":\"reached: path "));
    break;
  }
  RawClient foxglove(port);
  EXPECT_THAT(foxglove.Upgrade("foxglove.websocket.v1"), HasSubstr("101 "));
  program.Send(SIGINT);
  EXPECT_EQ(program.Wait().code, 0);
}

TEST_F(Inspect, APortThatIsNamedAndTakenIsAnErrorWithACure) {
  const auto other = WebServer::Start({.port = 0}, {}, {});
  ASSERT_TRUE(other);
  const std::string port = std::to_string((*other)->port());
  const Ended ended = Runnel("run --fast --inspect=" + port + " " + kUndrawnDemo);
  EXPECT_EQ(ended.code, 2) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("port " + port + " of 127.0.0.1 is taken"));
  EXPECT_THAT(ended.text, HasSubstr("0 for any that is free"));
}

TEST_F(Inspect, APortOfTheFileThatIsTakenIsReplacedWithANotice) {
  const auto other = WebServer::Start({.port = 0}, {}, {});
  ASSERT_TRUE(other);
  const std::string port = std::to_string((*other)->port());
  const Ended ended = Runnel("run --fast " + Write("<inspector port=\"" + port + "\" read_only=\"true\"/>"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, HasSubstr("warning: port " + port + " of 127.0.0.1 is taken"));
  EXPECT_THAT(ended.text, HasSubstr("the inspector takes "));
  EXPECT_THAT(ended.text, HasSubstr("inspector: http://127.0.0.1:"));
  EXPECT_THAT(ended.text, HasSubstr("reached: path "));
}

TEST_F(Inspect, IsLeftOutIfTheCommandLineSaysSo) {
  const Ended ended = Runnel("run --fast --no-inspect " + Write("<inspector port=\"0\"/>"));
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, Not(HasSubstr("inspector:")));
}

TEST_F(Inspect, WhatIsWrongInTheFileIsToldWithItsPlace) {
  const Ended ended =
      Runnel("check " + Write("<inspector port=\"99999\" address=\"here\" token=\"short\" read_only=\"no\"/>"));
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.text, HasSubstr("read_only"));
  const Ended values = Runnel("check " + Write("<inspector port=\"99999\" address=\"here\" token=\"short\"/>"));
  EXPECT_EQ(values.code, 2);
  EXPECT_THAT(values.text, HasSubstr("'99999' is not a port"));
  EXPECT_THAT(values.text, HasSubstr("'here' is not an address"));
  EXPECT_THAT(values.text, HasSubstr("the token cannot be used"));
  EXPECT_THAT(Runnel("check " + Write("<inspector/><inspector/>")).text, HasSubstr("there is an inspector already"));
}

TEST_F(Inspect, PlacesThatAreNoneAreRefused) {
  for (const char* option : {"--inspect=x", "--inspect=1.2.3:80", "--inspect=99999", "--inspect --inspect-token=short",
                             "--inspect=0 --no-inspect --hold"}) {
    const Ended ended = Runnel("run --fast " + std::string(option) + " " + kUndrawnDemo);
    EXPECT_EQ(ended.code, 2) << option << ended.text;
  }
}

TEST_F(Inspect, TokensComeFromAFileAndHaveRoles) {
  const std::string file = file_.string() + ".tokens";
  std::ofstream(file) << "look:just-look-7\ndrive:green-car-7\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  const std::uint16_t port = FreePort();
  Program program("run --fast --hold --inspect=" + std::to_string(port) + " --inspect-token-file=" + file + " " +
                  kUndrawnDemo);
  ASSERT_TRUE(program.WaitFor("held for viewers"));
  const auto access = [&](const std::string& token) {
    return RawClient(port).Get("/access", "Authorization: Bearer " + token + "\r\n");
  };
  EXPECT_THAT(access("just-look-7"), HasSubstr("\r\n\r\nlook"));
  EXPECT_THAT(access("green-car-7"), HasSubstr("\r\n\r\ndrive"));
  EXPECT_THAT(access("other-car-7"), HasSubstr(" 401 "));
  program.Send(SIGINT);
  const Ended ended = program.Wait();
  EXPECT_EQ(ended.code, 0) << ended.text;
  EXPECT_THAT(ended.text, Not(HasSubstr("-7")));
  std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
  const Ended refused = Runnel("run --fast --inspect=0 --inspect-token-file=" + file + " " + kUndrawnDemo);
  EXPECT_EQ(refused.code, 2) << refused.text;
  EXPECT_THAT(refused.text, AllOf(HasSubstr(file), HasSubstr("chmod 600")));
  std::filesystem::remove(file);
}

TEST_F(Inspect, ATokenThatIsMadeStandsInAFileAndNotInTheOutput) {
  const Ended ended = Runnel("run --fast --inspect=0.0.0.0:0 --inspect-insecure " + kUndrawnDemo);
  EXPECT_EQ(ended.code, 0) << ended.text;
  const std::string before = "(and #token=…, which is in ";
  const std::size_t found = ended.text.find(before);
  ASSERT_NE(found, std::string::npos) << ended.text;
  const std::size_t begin = found + before.size();
  const std::string file = ended.text.substr(begin, ended.text.find(')', begin) - begin);
  EXPECT_FALSE(std::filesystem::exists(file)) << "it is there for as long as the program runs";
}

TEST_F(Inspect, OtherAddressesAreNotServedInTheClear) {
  const Ended ended = Runnel("run --fast --inspect=0.0.0.0:0 " + kUndrawnDemo);
  EXPECT_EQ(ended.code, 2) << ended.text;
  EXPECT_THAT(ended.text, AllOf(HasSubstr("nothing is encrypted"), HasSubstr("--inspect-insecure")));
}

TEST_F(Inspect, ATokenThatIsGivenIsNotPrinted) {
  const Ended ended = Runnel("run --fast --inspect=0 --inspect-token=open-sesame " + kUndrawnDemo);
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.text, HasSubstr("/  (and #token=…)\n"));
  EXPECT_THAT(ended.text, Not(HasSubstr("sesame")));
}

}  // namespace
}  // namespace runnel::test
