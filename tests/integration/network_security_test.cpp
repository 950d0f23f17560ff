// Two applications that know each other by keys, which openssl makes: what they say, and who is let in.

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <linux/if_ether.h>
#include <linux/if_packet.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/integration/program.h"
#include "tests/support/own_network.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// All that goes through the network of this process, from now on.
class Capture {
 public:
  Capture() {
    constexpr int kRoom = 32 << 20;
    (void)setsockopt(descriptor_, SOL_SOCKET, SO_RCVBUFFORCE, &kRoom, sizeof kRoom);
  }
  ~Capture() { close(descriptor_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  /// Whether `text` was in any datagram; those are gone then.
  bool Finds(const std::string& text) {
    std::string packet(1 << 17, '\0');
    bool found = false;
    for (;;) {
      const ssize_t size = recv(descriptor_, packet.data(), packet.size(), MSG_DONTWAIT);
      if (size <= 0) return found;
      ++count_;
      found |= std::string_view(packet.data(), static_cast<std::size_t>(size)).find(text) != std::string_view::npos;
    }
  }
  [[nodiscard]] int count() const noexcept { return count_; }

 private:
  const int descriptor_ = socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_ALL));
  int count_ = 0;
};

/// With each engine.
class NetworkSecurity : public testing::TestWithParam<const char*> {
 protected:
  NetworkSecurity() {
    setenv("ROS_DOMAIN_ID", std::to_string(OwnDomain()).c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
  }
  ~NetworkSecurity() override {
    unsetenv("XDG_RUNTIME_DIR");
    unsetenv("ROS_DOMAIN_ID");
  }

  /// The shipped application, with `keys` unless they are "", and datagrams as between machines.
  std::unique_ptr<Program> Start(const std::string& name, const std::string& keys) {
    const std::string file = name == "robot" ? "two_robots.xml" : "two_robots_planner.xml";
    std::ifstream stream(std::string(RUNNEL_XML) + "/apps/" + file);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string tag = "<network name=\"" + name + "\"";
    text.insert(text.find(tag) + tag.size(), std::string(" datagram=\"1400\" engine=\"") + GetParam() + "\"");
    if (!keys.empty()) text.insert(text.find('>', text.find(tag)) + 1, "<security keys=\"" + keys + "\"/>");
    std::ofstream(folder_ / file) << text;
    const std::string world = name == "robot" ? " world=" RUNNEL_XML "/worlds/rooms.xml" : "";
    return std::make_unique<Program>("run " + (folder_ / file).string() + world);
  }
  void MakeKeys(const std::string& folder, const std::string& names) {
    const Ended ended = Runnel("keys " + (folder_ / folder).string() + " " + names);
    ASSERT_EQ(ended.code, kDone) << ended.text;
  }
  static void WaitUntilItDrives() {
    WaitUntil("the robot drives",
              [] { return Runnel("get --app robot /gate/wanted").text.find("forward: 0.") != std::string::npos; });
  }
  static void WaitUntilItSays(const std::string& text) {
    WaitUntil("the robot says '" + text + "'",
              [&] { return Runnel("network --app robot").text.find(text) != std::string::npos; });
  }

  const TemporaryFolder folder_;
};

TEST_P(NetworkSecurity, AKeyOfSomebodyElseIsToldWithItsFiles) {
  MakeKeys("keys", "robot planner");
  std::filesystem::copy_file(folder_ / "keys/planner/key.pem", folder_ / "keys/robot/key.pem",
                             std::filesystem::copy_options::overwrite_existing);
  const Ended ended = Start("robot", "keys/robot")->Wait();
  EXPECT_NE(ended.code, kDone);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("keys/robot/key.pem"), HasSubstr("keys/robot/cert.pem")));
}

TEST_P(NetworkSecurity, WithTheKeysOfOneAuthorityValuesFlowAndNobodyReadsThemOnTheWay) {
  if (OwnDomain() != 0) GTEST_SKIP() << "needs the right to see what goes through networks";
  const std::string topic = "localisation/pose";
  Capture capture;
  {
    const auto robot = Start("robot", "");
    const auto planner = Start("planner", "");
    WaitUntilItDrives();
    EXPECT_TRUE(capture.Finds(topic)) << "by which it would be found";
  }
  MakeKeys("keys", "robot planner");
  const auto robot = Start("robot", "keys/robot");
  (void)capture.Finds(topic);  // what is left of before: those of then are gone
  const auto planner = Start("planner", (folder_ / "keys/planner").string());
  WaitUntilItDrives();
  const int before = capture.count();
  EXPECT_FALSE(capture.Finds(topic));
  EXPECT_GT(capture.count(), before);
  EXPECT_THAT(Runnel("network --app robot").text, AllOf(HasSubstr("member planner"), Not(HasSubstr("NOT LET IN"))));
}

TEST_P(NetworkSecurity, WhoHasKeysOfAnotherAuthorityOrNoneIsNotLetInAndThatIsTold) {
  MakeKeys("keys", "robot planner");
  MakeKeys("others", "planner");
  const auto robot = Start("robot", "keys/robot");
  auto planner = Start("planner", "others/planner");
  WaitUntilItSays("planner: NOT LET IN");
  // The one that is asked by the other says why.
  WaitUntil("one of them says why", [] {
    return (Runnel("network --app robot").text + Runnel("network --app planner").text)
               .find("certificate signature failure") != std::string::npos;
  });
  EXPECT_THAT(Runnel("network --app robot").text, Not(HasSubstr("written by planner")));
  EXPECT_TRUE(robot->WaitFor("shows no keys that are trusted here"));
  planner = Start("planner", "");
  WaitUntil("the planner runs",
            [] { return Runnel("network --app planner").text.find("planner in domain") != std::string::npos; });
  EXPECT_THAT(Runnel("network --app planner").text, Not(HasSubstr("written by robot")));
  // The right one is let in all the same.
  planner = Start("planner", "keys/planner");
  WaitUntilItDrives();
}

// As SROS 2 writes policies: what is not said is denied.
TEST_P(NetworkSecurity, WithThePermissionsThatItsPortsNeedItRunsAndSaysWhatElseWouldBeTold) {
  MakeKeys("keys", "robot planner");
  std::ifstream stream(folder_ / "keys/robot/permissions.xml");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto allow = [&](const std::string& what, const std::string& topics) {
    const std::string all = "<" + what + "><topics><topic>*</topic></topics></" + what + ">";
    ASSERT_NE(text.find(all), std::string::npos);
    text.replace(text.find(all), all.size(), "<" + what + "><topics>" + topics + "</topics></" + what + ">");
  };
  allow(
      "publish",
      "<topic>rt/robot/laser/scan</topic><topic>rt/robot/localisation/pose</topic><topic>rt/robot/world/goal</topic>");
  allow("subscribe", "<topic>rt/planner/planner/twist</topic>");
  std::ofstream(folder_ / "permissions.xml") << text;
  const std::string sign = "cd " + folder_.path().string() +
                           " && openssl smime -sign -text -in permissions.xml -out keys/robot/permissions.p7s "
                           "-signer keys/ca.cert.pem -inkey keys/ca.key.pem 2>/dev/null";
  ASSERT_EQ(std::system(sign.c_str()), 0);
  const auto robot = Start("robot", "keys/robot");
  EXPECT_TRUE(
      robot->WaitFor("is to have <publish><topics><topic>rt/robot/runnel_structure</topic></topics></publish>"));
  const auto planner = Start("planner", "keys/planner");
  WaitUntilItDrives();
  (void)Runnel("ls --app robot //planner");
  EXPECT_TRUE(robot->WaitFor("<subscribe><topics><topic>rt/planner/runnel_structure</topic></topics></subscribe>"));
}

TEST_P(NetworkSecurity, FilesThatAreNotThereAreToldWithTheirPlace) {
  const std::string file = (folder_ / "wrong.xml").string();
  const auto check = [&](const std::string& security) {
    std::ofstream(file) << "<application name=\"base\">\n<network engine=\"" << GetParam() << "\">\n"
                        << security << "\n</network>\n</application>\n";
    return Runnel("check " + file).text;
  };
  MakeKeys("keys", "base");
  EXPECT_THAT(check(R"(<security keys="keys/base"/>)"), Not(HasSubstr("error:")));
  EXPECT_THAT(
      check(R"(<security keys="keys/bass"/>)"),
      AllOf(HasSubstr("wrong.xml:3:17"), HasSubstr("keys/bass/cert.pem"), HasSubstr("runnel keys FOLDER base")));
  EXPECT_THAT(check(R"(<security keys="keys/base" key="my.pem"/>)"),
              AllOf(HasSubstr("wrong.xml:3:33"), HasSubstr("my.pem")));
  EXPECT_THAT(check(R"(<security key="keys/base/key.pem"/>)"), HasSubstr("does not say where the certificate is"));
  // A file with something else in it is the engine's matter.
  std::ofstream(folder_ / "keys/base/permissions.p7s") << "nothing";
  (void)check(R"(<security keys="keys/base"/>)");
  const Ended ended = Runnel("run " + file + " --duration 1");
  EXPECT_NE(ended.code, kDone);
  EXPECT_THAT(ended.text, AllOf(HasSubstr("wrong.xml:2"), HasSubstr("the network cannot be joined")));
}

INSTANTIATE_TEST_SUITE_P(Cyclone, NetworkSecurity, testing::Values("cyclone"));
#if RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, NetworkSecurity, testing::Values("fast"));
#endif

}  // namespace
}  // namespace runnel::test
