// A terminal and a browser that change, reload, undo and redo the same application at once, while it runs.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/plugin/plugin_manager.h"
#include "core/port/port.h"
#include "plugins/command_service/command_service.h"
#include "plugins/control/control_client.h"
#include "plugins/control/control_server.h"
#include "plugins/inspector/inspector.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/structure/reload.h"
#include "plugins/web_server/web_server.h"
#include "tests/plugins/web_server/raw_client.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::chrono::milliseconds TimeToRun() {
  const char* const seconds = std::getenv("RUNNEL_TWO_CLIENTS_SECONDS");
  return seconds != nullptr ? std::chrono::seconds(std::atoi(seconds)) : 2000ms;
}

/// One way to ask an application for something; nothing: the connection is gone.
using Ask = std::function<std::optional<bool>(const std::string& what, const std::string& argument)>;

/// The few changes of this test, as the page tells them.
std::string ChangeMessage(const std::string& text) {
  std::istringstream words(text);
  std::string what, path, word;
  words >> what >> path;
  std::string json = "{\"change\":\"" + what + "\",\"path\":\"" + path + "\"";
  if (what == "replace" || what == "move") words >> word;  // with, to
  if (words >> word) json += (what == "move" ? ",\"thread\":\"" : ",\"type\":\"") + word + "\"";
  if (words >> word) json += ",\"probation\":" + word.substr(word.find('=') + 1);
  return json + "}";
}

/// What a client has been told.
struct Heard {
  std::map<std::string, int> done;
  std::map<std::string, int> refused;
  bool is_cut_off = false;

  [[nodiscard]] std::string Text() const {
    std::string text;
    for (const auto& [what, count] : done) text += what + " done " + std::to_string(count) + "; ";
    for (const auto& [what, count] : refused) {
      text += what + " refused " + std::to_string(count) + "; ";
    }
    return text;
  }
};

class TwoClients : public ::testing::Test {
 protected:
  TwoClients() {
    Build("1");
    plugins.AddSearchFolder(folder.path() / "plugins");
    EXPECT_TRUE(plugins.Load("counting"));
    for (const char* thread : {"main", "other"}) CreateThread(runtime, thread, {.period = 1ms});
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    const auto outcome = editor.Apply({CreateGroup{"/app"}, AssignToThread{"/app", "main"},
                                       CreateModule{"/app/kept", "counting/counting"},
                                       CreateModule{"/app/a", "counting/counting"}, AssignToThread{"/app/a", "other"}});
    EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
    EXPECT_TRUE(scheduler.Start());
    hooks.reload = [this](const std::string& plugin) -> Result<std::string> {
      Build(++builds_ % 2 == 0 ? "1" : "2");
      const auto reloaded = ReloadPlugin(plugins, editor, runtime, plugin);
      if (!reloaded) return reloaded.diagnostics.errors().front();
      return "loaded " + plugin + " anew";
    };
    service.emplace(ServedApplication{runtime, plugins.modules(), editor, log, hooks, &history, &scheduler.pace()});
    auto control = ControlServer::Start(*service, {.application = "app", .folder = folder.path() / "sockets"});
    EXPECT_TRUE(control) << control.error().ToString();
    server = std::move(*control);
    inspector = std::make_unique<Inspector>(*service, scheduler, InspectorOptions{.application = "app"});
    auto web_started =
        WebServer::Start({.port = 0, .limits = {.messages_per_second = 1e6}}, {}, {inspector->Protocol()});
    EXPECT_TRUE(web_started) << web_started.error().ToString();
    web = std::move(*web_started);
  }
  ~TwoClients() override {
    web.reset();
    inspector.reset();
    server.reset();
    service.reset();
    scheduler.Stop();
  }

  // By the constructor, then by the worker.
  void Build(const std::string& version) const {
    fs::create_directories(folder.path() / "plugins");
    const fs::path library = folder.path() / "plugins" / "counting.so";
    fs::copy_file(fs::path(RUNNEL_TEST_PLUGINS) / ("counting_" + version + ".so"), folder.path() / "new",
                  fs::copy_options::overwrite_existing);
    fs::rename(folder.path() / "new", library);
  }

  std::uint64_t CountOfKept() {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto port = runtime.root().Find("/app/kept/output/out");
    return port ? dynamic_cast<Port&>(**port).publications() : 0;
  }

  // Until the time is up.
  Heard Work(const std::string& name, const Ask& ask) {
    Heard heard;
    const auto end = std::chrono::steady_clock::now() + TimeToRun();
    const std::string own = "/app/" + name;
    const std::vector<std::pair<std::string, std::string>> round{
        {"change", "create " + own + " counting/counting"},
        {"change", "replace /app/a with counting/counting probation=2"},
        {"change", "move /app/a to main"},
        {"undo", ""},
        {"change", "replace " + own + " with counting/counting probation=0"},
        {"reload", "counting"},
        {"undo", ""},
        {"redo", ""},
        {"change", "move /app/a to other"},
        {"change", "delete " + own},
        {"undo", ""},
        {"change", "delete " + own}};
    while (std::chrono::steady_clock::now() < end && !heard.is_cut_off) {
      for (const auto& [what, argument] : round) {
        const auto is_done = ask(what, argument);
        if (!is_done) {
          heard.is_cut_off = true;
          break;
        }
        ++(*is_done ? heard.done : heard.refused)[what];
      }
    }
    return heard;
  }
  Heard WorkAsTerminal() {
    auto client = ControlClient::Connect(server->socket());
    EXPECT_TRUE(client) << client.error().ToString();
    return Work("terminal", [&](const std::string& what, const std::string& argument) -> std::optional<bool> {
      const std::string request = what == "change" ? "change\n" + argument : what + " " + argument;
      const auto ignored = [](std::string_view) { return true; };
      const auto code = client->Ask(request, ignored, ignored);
      if (!code) return {};
      return *code == 0;
    });
  }
  Heard WorkAsBrowser() {
    RawClient client(web->port());
    EXPECT_THAT(client.Upgrade("runnel.inspector.v1"), ::testing::HasSubstr("101 "));
    int number = 0;
    return Work("browser", [&](const std::string& what, const std::string& argument) -> std::optional<bool> {
      std::string message = "{\"op\":\"" + what + "\",\"request\":" + std::to_string(++number);
      if (what == "change") message += ",\"changes\":[" + ChangeMessage(argument) + "]";
      if (what == "reload") message += ",\"plugin\":\"" + argument + "\"";
      client.SendText(message + "}");
      const std::string head = "{\"op\":\"reply\",\"request\":" + std::to_string(number) + ",\"ok\":";
      for (;;) {
        const auto reply = client.Receive(1);
        if (!reply) return {};
        if (reply->payload.starts_with(head)) return reply->payload.starts_with(head + "true");
      }
    });
  }

  TemporaryFolder folder;
  PluginManager plugins;
  Runtime runtime;
  Scheduler scheduler{runtime};
  StructureEditor editor{runtime, plugins.modules(), &scheduler};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  ServiceHooks hooks;
  std::optional<CommandService> service;
  std::unique_ptr<ControlServer> server;
  std::unique_ptr<Inspector> inspector;
  std::unique_ptr<WebServer> web;

 private:
  int builds_ = 0;  // the worker's
};

TEST_F(TwoClients, ChangeReloadAndUndoAtOnceWhileTheApplicationRuns) {
  Heard browser;
  std::thread other([&] { browser = WorkAsBrowser(); });
  const Heard terminal = WorkAsTerminal();
  other.join();
  std::printf("terminal: %s\nbrowser: %s\n", terminal.Text().c_str(), browser.Text().c_str());
  for (const Heard& heard : {terminal, browser}) {
    EXPECT_FALSE(heard.is_cut_off);
    for (const char* what : {"change", "undo", "reload"}) {
      EXPECT_TRUE(heard.done.contains(what)) << what << " was never done";
    }
    EXPECT_FALSE(heard.refused.contains("reload")) << "a reload was disturbed by another one";
  }
  // What nobody has touched goes on, with the plugin that was loaded last.
  const std::uint64_t before = CountOfKept();
  EXPECT_GT(before, 0u);
  WaitUntil("the module that nobody touches publishes", [&] { return CountOfKept() > before; });
}

}  // namespace
}  // namespace runnel::test
