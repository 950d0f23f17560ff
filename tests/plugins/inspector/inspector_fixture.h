#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/type_builder.h"
#include "plugins/inspector/inspector.h"
#include "plugins/parameters/parameter.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/structure/change_history.h"
#include "plugins/web_server/web_server.h"
#include "tests/plugins/inspector/change_message.h"
#include "tests/plugins/web_server/raw_client.h"

namespace runnel::test {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Publishes 1, 2, 3 …
class Counter : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out", {.description = "how many so far"}};
  Parameter<double> speed{
      this, "speed", {.default_value = 1, .bounds = {0, 9}, .unit = "m/s", .description = "how fast it would be"}};
  StaticParameter<std::string> title{this, "title", {.default_value = "none"}};

 protected:
  void Update() override { out.Publish(++count_); }

 private:
  int count_ = 0;
};

class FastCounter final : public Counter {
 public:
  using Counter::Counter;
  Output<double> further{this, "further"};
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
  Input<int> in{this, "in", {.required = true}};

 private:
  void Update() override { (void)in.Read(); }
};

class Failing final : public Module {
 public:
  using Module::Module;
  Output<int> out{this, "out"};

 private:
  void Update() override { throw std::runtime_error("is worn out"); }
};

class Lists final : public Module {
 public:
  using Module::Module;
  Output<std::vector<double>> list{this, "list"};

 private:
  void Update() override {
    auto loan = list.Loan();
    loan->assign(1000, 0.5);
    list.Publish(std::move(loan));
  }
};

/// A viewer as the protocol has it.
class Viewer {
 public:
  /// `token`: as a protocol of its own; "": none.
  explicit Viewer(std::uint16_t port, const std::string& token = {},
                  const std::string& protocol = "runnel.inspector.v1")
      : client_(port) {
    EXPECT_THAT(client_.Upgrade(protocol + (token.empty() ? "" : ", " + token)), HasSubstr("101 "));
  }
  void Send(const Json& message) const { client_.SendText(message.dump()); }
  RawClient& raw() { return client_; }

  /// The next message with this "op"; others are passed over.
  Json Next(const std::string& op) {
    return Next([&](const Json& message) { return message["op"] == op; }, op);
  }
  Json Next(const std::function<bool(const Json&)>& is_wanted, const std::string& what) {
    for (int i = 0; i < 100'000; ++i) {
      const auto message = client_.Receive(1);
      if (!message) break;
      Json json = Json::parse(message->payload, nullptr, false);
      if (json.is_discarded()) {
        ADD_FAILURE() << "no JSON: " << message->payload.substr(0, 500);
        break;
      }
      if (is_wanted(json)) return json;
    }
    ADD_FAILURE() << "there was no " << what;
    return Json::object();
  }
  /// The reply to a request.
  Json Ask(Json message) {
    const int request = ++requests_;
    message["request"] = request;
    Send(message);
    return Next([&](const Json& reply) { return reply["op"] == "reply" && reply["request"] == request; },
                "reply to " + message.dump());
  }
  Json Change(const std::vector<std::string>& texts) {
    Json changes = Json::array();
    for (const std::string& text : texts) changes.push_back(ChangeMessage(text));
    return ChangeAsTold(changes);
  }
  Json ChangeAsTold(const Json& changes) { return Ask({{"op", "change"}, {"changes", changes}}); }
  /// The next value of a watched port.
  Json Value(const std::string& path) {
    for (;;) {
      const Json values = Next("values");
      if (!values.contains("items")) return {};
      for (const Json& item : values["items"]) {
        if (item["path"] == path) return item;
      }
    }
  }
  /// The element as it is told the next time.
  Json Element(const std::string& path) {
    for (;;) {
      const Json told =
          Next([](const Json& each) { return each["op"] == "structure" || each["op"] == "structure_change"; },
               "news of " + path);
      if (!told.contains("elements")) return {};
      for (const Json& element : told["elements"]) {
        if (element["path"] == path) return element;
      }
    }
  }

 private:
  RawClient client_;
  int requests_ = 0;
};

/// An application with an inspector: /app/a counts, /app/b takes it.
class InspectorTest : public ::testing::Test {
 protected:
  explicit InspectorTest(SchedulerOptions options = {}) : scheduler(runtime, options) {
    Register<Counter>("test/counter");
    Register<FastCounter>("test/fast_counter");
    Register<Sink>("test/sink");
    Register<Failing>("test/failing");
    Register<Lists>("test/lists");
    auto& app = runtime.Create<Group>(runtime.root(), "app");
    AssignThread(app, CreateThread(runtime, "main", {.period = 1ms}));
    for (const auto& [name, type] : {std::pair{"a", "test/counter"}, {"b", "test/sink"}}) {
      EXPECT_TRUE(modules.Create(type, app, name));
    }
    EXPECT_TRUE(Port::Connect(PortAt("/app/a/output/out"), PortAt("/app/b/input/in")));
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
  }
  ~InspectorTest() override {
    server.reset();
    inspector.reset();
    scheduler.Stop();
  }

  /// `options`: what a test wants otherwise.
  void Start(InspectorOptions options = {}, WebServerOptions web = {}) {
    options.application = "app";
    server.reset();
    inspector.reset();
    service = std::make_unique<CommandService>(
        ServedApplication{runtime, modules, editor, log, hooks, &history, &scheduler.pace(), &scheduler});
    inspector = std::make_unique<Inspector>(*service, scheduler, options);
    web.port = 0;
    auto started = WebServer::Start(web, {}, {inspector->Protocol()});
    ASSERT_TRUE(started) << started.error().ToString();
    server = std::move(*started);
  }
  [[nodiscard]] Viewer View() const { return Viewer(server->port()); }

  template <typename M>
  void Register(const std::string& name) {
    EXPECT_TRUE(modules.Add({name, "does it", "test", [](const Placement& placement) {
                               return std::unique_ptr<FrameworkElement>(std::make_unique<M>(placement));
                             }}));
  }
  Port& PortAt(const std::string& path) { return dynamic_cast<Port&>(*runtime.root().Find(path).value()); }
  void Set(const std::string& path, const std::string& value) {
    auto* const parameter = dynamic_cast<Configurable*>(*runtime.root().Find(path));
    ASSERT_NE(parameter, nullptr);
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(parameter->SetFromText(value));
  }
  /// Changes that are right.
  void Apply(const std::string& changes) {
    Diagnostics diagnostics;
    const PlacedChanges placed = ParseChanges(changes, {}, diagnostics);
    const auto outcome = editor.Apply(placed.changes);
    EXPECT_TRUE(diagnostics.ok() && outcome) << diagnostics.ToString() << outcome.diagnostics.ToString();
  }

  Runtime runtime;
  ModuleRegistry modules;
  Scheduler scheduler;
  StructureEditor editor{runtime, modules, &scheduler};
  ChangeHistory history{editor};
  ApplicationLog log{runtime.clock()};
  ServiceHooks hooks;
  std::unique_ptr<CommandService> service;
  std::unique_ptr<Inspector> inspector;
  std::unique_ptr<WebServer> server;
};

/// The same, running on the real clock.
class RunningInspectorTest : public InspectorTest {
 protected:
  RunningInspectorTest() { EXPECT_TRUE(scheduler.Start()); }
};

/// The same on the simulated clock, run by the test.
class SimulatedInspectorTest : public InspectorTest {
 protected:
  SimulatedInspectorTest() : InspectorTest({.clock = SchedulerOptions::ClockKind::kSimulated}) {}
};

}  // namespace runnel::test
