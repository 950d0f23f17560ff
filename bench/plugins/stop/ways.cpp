#include "bench/plugins/stop/ways.h"

#include <cstdio>
#include <cstdlib>

#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugins/control/control_client.h"
#include "tests/plugins/web_server/raw_client.h"

extern char** environ;

namespace runnel::bench {

namespace {

using namespace std::chrono_literals;

std::vector<double> Took(SteadyClock::time_point begin, const std::vector<SteadyClock::time_point>& ends) {
  std::vector<double> took;
  for (const auto& each : ends) took.push_back(std::chrono::duration<double, std::milli>(each - begin).count());
  return took;
}

class ByService final : public Way {
 public:
  explicit ByService(Robot& robot) : robot_(robot), tasks_(robot.service->worker()) {}
  std::vector<double> Press() override {
    const auto begin = SteadyClock::now();
    (void)robot_.service->Begin(RobotStopRequest{true, "bench"}, tasks_);
    return Took(begin, robot_.UntilSafe());
  }

 private:
  Robot& robot_;
  TaskGroup tasks_;
};

// As `runnel stop` does it, from looking for the application's socket until the answer has come.
class ByTerminal final : public Way {
 public:
  explicit ByTerminal(Robot& robot) : robot_(robot) {}
  std::vector<double> Press() override {
    const auto begin = SteadyClock::now();
    auto client = ControlClient::Connect(robot_.control->socket());
    if (!client) Fail(client.error().ToString());
    const auto pass = [](std::string_view) { return true; };
    const auto code = client->Ask("stop", pass, pass);
    if (!code || *code != 0) Fail("the STOP of a terminal has been refused");
    return Took(begin, robot_.UntilSafe());
  }

 private:
  Robot& robot_;
};

// As the page does it, from the octets that it sends.
class ByWebSocket final : public Way {
 public:
  explicit ByWebSocket(Robot& robot) : robot_(robot), client_(robot.web->port()) {
    (void)client_.Upgrade("runnel.stop.v1");
  }
  std::vector<double> Press() override {
    const auto begin = SteadyClock::now();
    if (!client_.SendText(R"({"op":"stop","request":1})")) Fail("the connection of the STOP has been closed");
    const std::vector<double> took = Took(begin, robot_.UntilSafe());
    for (;;) {
      const auto message = client_.Receive(1);
      if (!message) Fail("the connection of the STOP has been closed");
      if (message->payload.find(R"("op":"reply")") != std::string::npos) return took;
    }
  }

 private:
  Robot& robot_;
  test::RawClient client_;
};

/// When it was by the machine's wall clock, which is in ms.
SteadyClock::time_point ByWallClock(double time) {
  const std::chrono::duration<double, std::milli> now = std::chrono::system_clock::now().time_since_epoch();
  return SteadyClock::now() -
         std::chrono::duration_cast<SteadyClock::duration>(now - std::chrono::duration<double, std::milli>(time));
}

// From the event of the mouse or the key, as the browser has stamped it, in headless Chromium.
class ByPage final : public Way {
 public:
  ByPage(Robot& robot, bool fills_page) : robot_(robot) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) Fail("cannot make a pair of sockets");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int each : {0, 1}) posix_spawn_file_actions_adddup2(&actions, ends[1], each);
    const std::string script = RUNNEL_BROWSER_TESTS "/long/press_stop.mjs";
    std::string words[] = {"node", script, robot.web->url(), fills_page ? "saturated" : ""};
    char* const arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
    if (posix_spawnp(&process_, "node", &actions, nullptr, arguments, environ) != 0) process_ = 0;
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    page_ = fdopen(ends[0], "r+");
    is_there_ = process_ != 0 && Line() == "ready";
  }
  ~ByPage() override {
    (void)std::fclose(page_);  // it ends then
    if (process_ != 0) waitpid(process_, nullptr, 0);
  }
  [[nodiscard]] bool is_there() const noexcept { return is_there_; }

  std::vector<double> Press() override {
    (void)std::fputs("press\n", page_);
    (void)std::fflush(page_);
    const auto safe = robot_.UntilSafe(100us);
    const std::string pressed = Line();
    if (pressed.empty()) Fail("the page is gone");
    return Took(ByWallClock(std::strtod(pressed.c_str(), nullptr)), safe);
  }

 private:
  std::string Line() {
    char line[200] = "";
    if (std::fgets(line, sizeof line, page_) == nullptr) return "";
    std::string text = line;
    return text.substr(0, text.find('\n'));
  }

  Robot& robot_;
  pid_t process_ = 0;
  std::FILE* page_ = nullptr;
  bool is_there_ = false;
};

}  // namespace

const std::vector<KindOfWay>& KindsOfWays() {
  static const std::vector<KindOfWay> kKinds = {
      {"from request to reader",
       [](Robot& robot, bool) -> std::unique_ptr<Way> { return std::make_unique<ByService>(robot); }},
      {"from 'runnel stop' to reader",
       [](Robot& robot, bool) -> std::unique_ptr<Way> { return std::make_unique<ByTerminal>(robot); }},
      {"from the page's octets to reader",
       [](Robot& robot, bool) -> std::unique_ptr<Way> { return std::make_unique<ByWebSocket>(robot); }},
      {"from click or key in Chromium to reader", [](Robot& robot, bool fills_page) -> std::unique_ptr<Way> {
         auto page = std::make_unique<ByPage>(robot, fills_page);
         if (page->is_there()) return page;
         std::printf("skipped: neither node nor Chromium, or the tests in a browser are not built\n");
         return nullptr;
       }}};
  return kKinds;
}

}  // namespace runnel::bench
