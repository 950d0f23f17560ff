// Callers and servers in threads of their own.

#include <thread>

#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

class ServiceThreads : public RealEditorTest {
 protected:
  ServiceThreads() {
    Register<Server>("test/server");
    Register<Asker>("test/asker");
    Must({CreateModule{"/app/server", "test/server"}, CreateModule{"/app/asker", "test/asker"},
          AssignToThread{"/app/server", "fast"}, AssignToThread{"/app/asker", "slow"},
          ConnectPorts{"/app/server/repeat", "/app/asker/repeat"}});
  }
};

TEST_F(ServiceThreads, WaitingOutsideOfCyclesGetsTheAnswer) {
  ASSERT_TRUE(scheduler.Start());
  auto& client = At<Asker>("/app/asker").repeat;
  for (int i = 1; i < 5; ++i) {
    auto future = client.Begin("x", i);
    const auto outcome = future.Wait();
    ASSERT_TRUE(outcome) << outcome.error();
    EXPECT_EQ(*outcome, std::string(i, 'x'));
  }
}

// Many threads call by one client, while the server is made anew again and again: each call ends, and each answer is
// that of its question.
TEST_F(ServiceThreads, EachAnswerIsThatOfItsQuestion) {
  ASSERT_TRUE(scheduler.Start());
  auto& client = At<Asker>("/app/asker").repeat;
  std::atomic<int> answered{0};
  std::vector<std::thread> callers;
  for (char letter = 'a'; letter < 'd'; ++letter) {
    callers.emplace_back([&, letter] {
      for (int i = 1; i <= 30; ++i) {
        auto future = client.Begin(std::string(1, letter), i);
        const auto outcome = future.Wait();
        if (!outcome) continue;
        EXPECT_EQ(*outcome, std::string(i, letter));
        ++answered;
      }
    });
  }
  for (int i = 0; i < 5; ++i) Must({ReplaceModule{"/app/server", "test/server"}});
  for (auto& each : callers) each.join();
  EXPECT_EQ(answered, 90) << "a swap loses no call";
}

}  // namespace
}  // namespace runnel::test
