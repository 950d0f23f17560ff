#include "plugins/control/control_folder.h"

#include <atomic>
#include <fstream>
#include <thread>

#include <sys/stat.h>
#include <sys/un.h>

#include "tests/plugins/control/control_fixture.h"

namespace runnel::test {

namespace {

mode_t ModeOf(const std::filesystem::path& path) {
  struct stat status {};
  EXPECT_EQ(lstat(path.c_str(), &status), 0) << path;
  return status.st_mode & 0777;
}

// As a process leaves it that is killed.
void LeaveStaleSocket(const std::filesystem::path& path) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  close(descriptor);
}

}  // namespace

TEST(ControlFolder, FollowsTheEnvironment) {
  const char* const before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before != nullptr ? before : "";
  setenv("XDG_RUNTIME_DIR", "/some/where", 1);
  EXPECT_EQ(ControlFolder(), "/some/where/runnel");
  unsetenv("XDG_RUNTIME_DIR");
  EXPECT_EQ(ControlFolder(), "/tmp/runnel-" + std::to_string(geteuid()));
  if (before != nullptr) setenv("XDG_RUNTIME_DIR", kept.c_str(), 1);
}

TEST(ControlFolder, IsMadeForItsOwnerOnlyAndSoIsTheSocket) {
  const mode_t mask = umask(0);
  TemporaryFolder folder;
  const auto listening = ListenInFolder(folder.path() / "runnel");
  umask(mask);
  ASSERT_TRUE(listening) << listening.error().ToString();
  EXPECT_EQ(ModeOf(folder.path() / "runnel"), 0700U);
  EXPECT_EQ(ModeOf(listening->path), 0600U);
}

TEST(ControlFolder, IsRefusedIfOthersCouldGetIn) {
  TemporaryFolder folder;
  const auto open = folder.path() / "open";
  ASSERT_EQ(mkdir(open.c_str(), 0700), 0);
  ASSERT_EQ(chmod(open.c_str(), 0750), 0);
  EXPECT_THAT(MakeControlFolder(open).error().message, HasSubstr("is open to others"));
  EXPECT_THAT(FindControlSockets(open).error().message, HasSubstr("is open to others"));
  ASSERT_EQ(mkdir((folder.path() / "mine").c_str(), 0700), 0);
  std::filesystem::create_directory_symlink(folder.path() / "mine", folder.path() / "link");
  EXPECT_THAT(MakeControlFolder(folder.path() / "link").error().message, HasSubstr("is not a folder"));
  std::ofstream(folder.path() / "file") << "x";
  EXPECT_FALSE(ListenInFolder(folder.path() / "file"));
  EXPECT_FALSE(ListenInFolder(folder.path() / "not" / "there"));
}

TEST(ControlFolder, OfAnotherUserIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can give a folder away";
  TemporaryFolder folder;
  const auto other = folder.path() / "other";
  ASSERT_EQ(mkdir(other.c_str(), 0700), 0);
  ASSERT_EQ(chown(other.c_str(), 12345, 12345), 0);
  EXPECT_THAT(MakeControlFolder(other).error().message, HasSubstr("belongs to another user"));
}

TEST(ControlFolder, LosesTheSocketsOfTheDead) {
  TemporaryFolder folder;
  const auto listening = ListenInFolder(folder.path());
  ASSERT_TRUE(listening);
  LeaveStaleSocket(folder.path() / "1.sock");
  LeaveStaleSocket(folder.path() / "999999999.sock");
  std::ofstream(folder.path() / "2.sock") << "no socket";
  const auto found = FindControlSockets(folder.path());
  ASSERT_TRUE(found);
  EXPECT_THAT(*found, ::testing::ElementsAre(listening->path));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "1.sock"))
      << "who has that number lives, and may begin to listen";
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "999999999.sock"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "2.sock"));
}

TEST(ControlFolder, LetsAProcessHaveSeveralSocketsAndTakeOverAStaleOne) {
  TemporaryFolder folder;
  const auto name = folder.path() / (std::to_string(getpid()) + ".sock");
  LeaveStaleSocket(name);
  const auto first = ListenInFolder(folder.path());
  const auto second = ListenInFolder(folder.path());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->path, name);
  EXPECT_NE(second->path, name);
  EXPECT_THAT(*FindControlSockets(folder.path()), SizeIs(2));
}

TEST(ControlFolder, KeepsTheSocketOfAnApplicationThatIsJustStarting) {
  const TemporaryFolder temporary;
  const auto folder = temporary.path() / "runnel";
  std::atomic<bool> is_over{false};
  std::thread client([&] {
    while (!is_over) (void)FindControlSockets(folder);
  });
  int lost = 0;
  for (int i = 0; i < 2'000; ++i) {
    const auto socket = ListenInFolder(folder);
    ASSERT_TRUE(socket) << socket.error().ToString();
    if (!std::filesystem::exists(socket->path)) ++lost;
    unlink(socket->path.c_str());
  }
  is_over = true;
  client.join();
  EXPECT_EQ(lost, 0);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(ControlFolder, LosesWhatAProcessThatDiedWhileItStartedHasLeft) {
  const TemporaryFolder folder;
  LeaveStaleSocket(folder.path() / "999999999-1.starting");
  LeaveStaleSocket(folder.path() / (std::to_string(getpid()) + "-0.starting"));
  EXPECT_THAT(FindControlSockets(folder.path()).value(), IsEmpty());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "999999999-1.starting"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / (std::to_string(getpid()) + "-0.starting")));
}

TEST(ControlFolder, SaysThatAPathIsTooLong) {
  TemporaryFolder folder;
  const auto deep = folder.path() / std::string(120, 'x');
  EXPECT_THAT(ListenInFolder(deep).error().message, HasSubstr("107 bytes at most"));
  EXPECT_THAT(ConnectToSocket(deep / "1.sock").error().message, HasSubstr("107 bytes at most"));
}

TEST_F(ControlTest, RemovesItsSocketAtTheEnd) {
  const auto path = server->socket();
  EXPECT_TRUE(std::filesystem::exists(path));
  server.reset();
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace runnel::test
