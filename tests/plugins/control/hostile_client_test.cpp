#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/plugins/control/control_fixture.h"
#include "tests/support/held_resources.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

namespace {

std::uint64_t PublicationsOf(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto port = runtime.root().Find(path);
  EXPECT_TRUE(port);
  return port ? dynamic_cast<Port&>(**port).publications() : 0;
}

/// What another user of this machine hears from a server's socket; "": nothing, since he does not get there.
std::string HeardByAnotherUser(const std::filesystem::path& socket) {
  constexpr uid_t kNobody = 65534;
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    if (setgid(kNobody) != 0 || setuid(kNobody) != 0) _exit(1);
    const auto connected = ConnectToSocket(socket);
    char heard[4096];
    const ssize_t count = connected ? recv(connected->number(), heard, sizeof heard, 0) : 0;
    if (count > 0) (void)!write(ends[1], heard, static_cast<std::size_t>(count));
    _exit(0);
  }
  close(ends[1]);
  std::string heard(4096, ' ');
  heard.resize(static_cast<std::size_t>(std::max<ssize_t>(0, read(ends[0], heard.data(), heard.size()))));
  close(ends[0]);
  int status = 1;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  return heard;
}

}  // namespace

// Each of the three would do: the folder, the mode of the socket, the question whose process it is.
TEST_F(ControlTest, HearsNoOtherUser) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can become another user";
  const std::filesystem::path socket = server->socket();
  EXPECT_EQ(HeardByAnotherUser(socket), "");
  for (const auto& each : {folder.path(), folder.path() / "runnel"}) chmod(each.c_str(), 0755);
  EXPECT_EQ(HeardByAnotherUser(socket), "");
  chmod(socket.c_str(), 0666);
  EXPECT_EQ(HeardByAnotherUser(socket), "");
  EXPECT_EQ(Ask("ls").code, 0) << "its own user goes on";
}

TEST_F(ControlTest, AnswersOthersWhileOneHasSentHalfARequest) {
  const int half = RawClient();
  SendAll(half, "request 1000\nls");
  EXPECT_EQ(Ask("ls").code, 0);
  close(half);
  EXPECT_EQ(Ask("ls").code, 0);
}

TEST_F(ControlTest, AnswersOthersWhileOneNeverReads) {
  ASSERT_EQ(Change("create /image test/image").code, 0);
  const int deaf = RawClient();
  SendAll(deaf, FrameBytes("request", "echo /image/image full=yes"));
  const int flood = RawClient();
  std::string requests;
  for (int i = 0; i < 2'000; ++i) requests += FrameBytes("request", "ls");
  // As much as the system takes; the rest the server has not read.
  (void)!send(flood, requests.data(), requests.size(), MSG_NOSIGNAL);
  const std::uint64_t before = PublicationsOf(runtime, "/app/image/output/image");
  for (int i = 0; i < 20; ++i) EXPECT_EQ(Ask("ls").code, 0);
  WaitUntil("the image is published for 20 more times",
            [&] { return PublicationsOf(runtime, "/app/image/output/image") >= before + 20; });
  close(deaf);
  close(flood);
}

TEST_F(ControlTest, CountsWhatASlowReaderMisses) {
  ASSERT_EQ(Change("create /image test/image").code, 0);
  auto client = Client();
  int values = 0;
  std::string all;
  (void)client.Ask(
      "echo /image/image full=yes",
      [&](std::string_view text) {
        all += text.substr(0, 60);
        // What the server sends meanwhile does not fit into the socket: it waits for this.
        const std::uint64_t count = PublicationsOf(runtime, "/app/image/output/image");
        WaitUntil("ten more images are published",
                  [&] { return PublicationsOf(runtime, "/app/image/output/image") >= count + 10; });
        return ++values < 8;
      },
      [](std::string_view) { return true; });
  EXPECT_EQ(values, 8);
  EXPECT_THAT(all, ::testing::ContainsRegex(", [1-9][0-9]* not shown\\)  "));
}

TEST_F(ControlTest, RefusesWhatIsTooLongBeforeItHasCome) {
  const int client = RawClient();
  SendAll(client, "request 1048577\n");
  EXPECT_THAT(ReadAll(client), HasSubstr("too long"));
  close(client);
}

TEST_F(ControlTest, RefusesWhatIsNoFrameAndHangsUp) {
  for (const char* bytes :
       {"GET / HTTP/1.1\r\n\r\n", "\n", "reply 2\nls\n", "request 2\nlsX", "request 99999999999999999999\n"}) {
    const int client = RawClient();
    SendAll(client, bytes);
    EXPECT_THAT(ReadAll(client), HasSubstr("error: ")) << bytes;
    close(client);
  }
  EXPECT_EQ(Ask("ls").code, 0);
}

// Each of these was carried out as if the wrong word had not been there.
TEST_F(ControlTest, CarriesOutNothingOfWhichItKnowsOnlyAPart) {
  bool has_saved = false;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    has_saved = true;
    return std::string("saved");
  };
  EXPECT_THAT(Ask("save config=true").errors, HasSubstr("'save': config is 'yes' or left out, not 'true'"));
  EXPECT_THAT(Ask("save overwrite=no").errors, HasSubstr("overwrite is 'yes' or left out"));
  EXPECT_EQ(Ask("save\nother.xml").code, 2);
  EXPECT_FALSE(has_saved);
  EXPECT_THAT(Ask("ls long=no").errors, HasSubstr("long is 'yes' or left out, not 'no'"));
  EXPECT_THAT(Ask("pause\n/a").errors, HasSubstr("'pause' is one line only"));
  const int confused = RawClient();
  SendAll(confused, FrameBytes("at", "noon") + FrameBytes("request", "set /a/speed 2"));
  EXPECT_THAT(ReadAll(confused), HasSubstr("a frame 'at' without a time"));
  close(confused);
  EXPECT_EQ(Ask("stop").code, 1) << "nothing is marked as driving";
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

TEST_F(ControlTest, TakesOnlySoManyClientsAndSaysSo) {
  StartServer({.application = "app", .folder = folder.path() / "runnel", .most_clients = 4});
  std::vector<ControlClient> clients;
  for (int i = 0; i < 4; ++i) clients.push_back(Client());
  EXPECT_THAT(Ask("ls").errors, HasSubstr("4 clients already"));
  EXPECT_EQ(test::Ask(clients[0], "ls").code, 0);
  clients.pop_back();
  // The server learns of it in a moment.
  while (Ask("ls").code != 0) continue;
}

// Whoever occupies the others, or floods them: who comes to stop the robot does so.
TEST_F(ControlTest, HasRoomForWhoPressesStop) {
  StartServer({.application = "app", .folder = folder.path() / "runnel", .most_clients = 2});
  std::vector<ControlClient> busy;
  for (int i = 0; i < 2; ++i) busy.push_back(Client());
  std::string requests;
  for (int i = 0; i < 2000; ++i) requests += FrameBytes("request", "ls");
  const int flooding = RawClient();
  SendAll(flooding, requests.substr(0, 20'000));
  EXPECT_THAT(Ask("stop").output, HasSubstr("STOP is in force"));
  EXPECT_TRUE(runtime.robot_stop().in_force());
  std::vector<ControlClient> more;
  for (int i = 0; i < 8; ++i) {
    auto client = ControlClient::Connect(server->socket());
    if (client) more.push_back(std::move(*client));
  }
  const auto refused = ControlClient::Connect(server->socket());
  ASSERT_FALSE(refused) << "memory and descriptors have a bound, too";
  EXPECT_THAT(refused.error().message, HasSubstr("2 clients already"));
  close(flooding);
}

TEST_F(ControlTest, ServesManyAtOnce) {
  std::vector<std::thread> threads;
  std::atomic<int> good{0};
  for (int i = 0; i < 16; ++i) {
    threads.emplace_back([&, i] {
      auto client = Client();
      const std::string path = "/c" + std::to_string(i);
      for (int round = 0; round < 10; ++round) {
        good += test::Ask(client, "change\ncreate " + path + " test/counter").code == 0;
        good += test::Ask(client, "echo " + path + "/out count=2").code == 0;
        good += test::Ask(client, "ls").code == 0;
        good += test::Ask(client, "change\ndelete " + path).code == 0;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good.load(), 16 * 10 * 4);
}

TEST_F(ControlTest, LosesNoDescriptorOverManyClientsThatComeAndGo) {
  const auto count = [] { return HeldResources().files; };
  (void)Ask("ls");
  const auto before = count();
  for (int i = 0; i < 500; ++i) {
    const int client = RawClient();
    SendAll(client, FrameBytes("request", i % 2 == 0 ? "echo /a/out" : "log follow=yes"));
    close(client);
  }
  while (count() > before + 1) (void)Ask("types");
}

TEST_F(ControlTest, EndsWhileClientsWaitForAnswers) {
  const int echo = RawClient();
  SendAll(echo, FrameBytes("request", "log follow=yes"));
  const int idle = RawClient();
  const int half = RawClient();
  SendAll(half, "request 10\n");
  (void)Ask("ls");
  server.reset();
  EXPECT_THAT(ReadAll(echo), HasSubstr("the application has ended"));
  (void)ReadAll(idle);
  (void)ReadAll(half);
  for (const int each : {echo, idle, half}) close(each);
}

TEST_F(ControlTest, EndsWhileChangesAreBeingMade) {
  for (int round = 0; round < 10; ++round) {
    const int client = RawClient();
    std::string all;
    for (int i = 0; i < 20; ++i) {
      all += FrameBytes("request", "change\nreplace /a with test/counter probation=1000000");
    }
    SendAll(client, all);
    if (round % 2 == 0) ReadAll(client, "hello");
    StartServer({.application = "app", .folder = folder.path() / "runnel"});
    close(client);
  }
  EXPECT_EQ(Ask("ls /a").code, 0);
}

TEST_F(ControlTest, RefusesChangesWithoutEnd) {
  std::string text;
  for (int i = 0; i < 20'001; ++i) text += "delete /x\n";
  EXPECT_THAT(Change(text).errors, HasSubstr("more than 20000 changes"));
  std::string wrong;
  for (int i = 0; i < 3'000; ++i) wrong += "delete /x\n";
  const Told told = Change(wrong);
  EXPECT_EQ(told.code, 2);
  EXPECT_THAT(told.errors, HasSubstr("and 2900 more errors"));
}

TEST_F(ControlTest, DoesNotWaitForWhoHoldsTheStructureLock) {
  std::thread holder;
  std::atomic<bool> is_held{false};
  std::atomic<bool> may_go{false};
  holder = std::thread([&] {
    const std::lock_guard lock(runtime.structure_mutex());
    is_held.store(true);
    WaitUntil("the structure lock may be let go of", [&] { return may_go.load(); });
  });
  WaitUntil("the structure lock is held", [&] { return is_held.load(); });
  const int waiting = RawClient();
  SendAll(waiting, FrameBytes("request", "ls"));
  EXPECT_EQ(Ask("log").code, 0);  // needs no lock
  may_go.store(true);
  holder.join();
  EXPECT_THAT(ReadAll(waiting, "end 1\n0\n"), HasSubstr("test/counter"));
  close(waiting);
}

}  // namespace runnel::test
