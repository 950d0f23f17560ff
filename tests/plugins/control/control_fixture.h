#pragma once

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/control/control_client.h"
#include "plugins/control/control_folder.h"
#include "plugins/control/control_server.h"
#include "plugins/parameters/parameter.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "tests/support/temporary_folder.h"

namespace runnel::test {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Publishes 1, 2, 3 …
class Counter : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};
  Parameter<double> speed{this, "speed", {.default_value = 1, .bounds = {0, 9}, .unit = "m/s"}};

 protected:
  void Update() override { out.Publish(++count_); }

 private:
  int count_ = 0;
};

/// Publishes what it has measured a quarter of a second ago.
class Lagging final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  void Update() override { out.Publish(7, now() - std::chrono::milliseconds(250)); }
};

class Sink final : public Module {
 public:
  using Module::Module;
  Input<int> in{this, "in"};

 private:
  void Update() override { (void)in.Read(); }
};

/// Works for three cycles.
class Failing final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  void Update() override {
    if (++cycles_ > 3) throw std::runtime_error("is worn out");
  }
  int cycles_ = 0;
};

class Image final : public Module {
 public:
  using Module::Module;
  Output<std::vector<std::uint8_t>> image{this, "image"};

 private:
  void Update() override {
    auto loan = image.Loan();
    loan->assign(100'000, 7);
    image.Publish(std::move(loan));
  }
};

/// What a client was told.
struct Told {
  int code = -1;
  std::string output;
  std::string errors;
};

inline Told Ask(ControlClient& client, const std::string& request) {
  Told told;
  const auto to = [](std::string& text) {
    return [&text](std::string_view part) {
      text += part;
      return true;
    };
  };
  const auto code = client.Ask(request, to(told.output), to(told.errors));
  told.code = code ? *code : -1;
  if (!code) told.errors += code.error().ToString();
  return told;
}

/// An application on the real clock, with a server.
class ControlTest : public ::testing::Test {
 protected:
  ControlTest() {
    Register<Counter>("test/counter");
    Register<Sink>("test/sink");
    Register<Lagging>("test/lagging");
    Register<Failing>("test/failing");
    Register<Image>("test/image");
    auto& app = runtime.Create<Group>(runtime.root(), "app");
    AssignThread(app, CreateThread(runtime, "main", {.period = 1ms}));
    for (const auto& [name, type] : {std::pair{"a", "test/counter"}, {"b", "test/sink"}}) {
      EXPECT_TRUE(modules.Create(type, app, name));
    }
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    EXPECT_TRUE(scheduler.Start());
    StartServer({.application = "app", .folder = folder.path() / "runnel"});
  }
  ~ControlTest() override {
    server.reset();
    scheduler.Stop();
  }

  template <typename M>
  void Register(const std::string& name) {
    EXPECT_TRUE(modules.Add({name, "does it", "test", [](const Placement& placement) {
                               return std::unique_ptr<FrameworkElement>(std::make_unique<M>(placement));
                             }}));
  }
  void StartServer(ControlOptions options) {
    server.reset();
    service = std::make_unique<CommandService>(
        ServedApplication{runtime, modules, editor, log, hooks, &history, &scheduler.pace(), &scheduler});
    auto started = ControlServer::Start(*service, std::move(options));
    ASSERT_TRUE(started) << started.error().ToString();
    server = std::move(*started);
  }

  ControlClient Client() {
    auto client = ControlClient::Connect(server->socket());
    EXPECT_TRUE(client) << client.error().ToString();
    return std::move(*client);
  }
  Told Ask(const std::string& request) {
    auto client = Client();
    return test::Ask(client, request);
  }
  Told Change(const std::string& text) { return Ask("change\n" + text); }

  /// A connected socket of which the test has full use; the hello has not been read.
  int RawClient() {
    const auto connected = ConnectToSocket(server->socket());
    EXPECT_TRUE(connected);
    if (!connected) return -1;
    fcntl(connected->number(), F_SETFL, O_NONBLOCK);
    return dup(connected->number());
  }
  /// What comes until the server closes the connection, or says `until`, or
  /// nothing for too long.
  static std::string ReadAll(int descriptor, const std::string& until = "\n\n never \n\n",
                             int timeout_milliseconds = 20'000) {
    std::string text;
    char bytes[65'536];
    for (;;) {
      pollfd polled{descriptor, POLLIN, 0};
      if (poll(&polled, 1, timeout_milliseconds) <= 0) return text + " (nothing more came)";
      const ssize_t count = recv(descriptor, bytes, sizeof bytes, 0);
      if (count <= 0) return text;
      text.append(bytes, static_cast<std::size_t>(count));
      if (text.find(until) != std::string::npos) return text;
    }
  }
  static void SendAll(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t count = send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (count > 0) {
        bytes.remove_prefix(static_cast<std::size_t>(count));
        continue;
      }
      if (errno != EAGAIN && errno != EINTR) return;  // the server has closed it
      pollfd polled{descriptor, POLLOUT, 0};
      poll(&polled, 1, 20'000);
    }
  }

  TemporaryFolder folder;
  Runtime runtime;
  ModuleRegistry modules;
  Scheduler scheduler{runtime};
  StructureEditor editor{runtime, modules, &scheduler};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  ServiceHooks hooks;
  std::unique_ptr<CommandService> service;
  std::unique_ptr<ControlServer> server;
};

}  // namespace runnel::test
