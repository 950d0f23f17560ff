#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <semaphore>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"
#include "modules/types/measurements.h"
#include "modules/types/pose.h"
#include "plugins/foxglove/foxglove.h"
#include "plugins/parameters/parameter.h"
#include "plugins/structure/structure_editor.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

/// Another thread that has the structure lock, for as long as this lives.
class HeldStructure {
 public:
  explicit HeldStructure(Runtime& runtime) : other_([this, &runtime] { HoldIn(runtime); }) { is_held_.acquire(); }
  ~HeldStructure() {
    is_over_.release();
    other_.join();
  }
  HeldStructure(const HeldStructure&) = delete;
  HeldStructure& operator=(const HeldStructure&) = delete;

 private:
  void HoldIn(Runtime& runtime) {
    const std::lock_guard structure(runtime.structure_mutex());
    is_held_.release();
    is_over_.acquire();
  }

  std::binary_semaphore is_held_{0};
  std::binary_semaphore is_over_{0};
  std::thread other_;
};

/// The other end of a session: keeps what is sent.
class FakeWebClient final : public WebClient {
 public:
  bool SendText(std::string text) override {
    if (is_slow) return false;
    texts.push_back(Json::parse(text));
    return true;
  }
  bool SendBinary(std::string bytes) override {
    if (is_slow) return false;
    binaries.push_back(std::move(bytes));
    return true;
  }
  [[nodiscard]] std::size_t waiting_bytes() const override { return waiting; }
  void Close(std::string reason) override { closed = std::move(reason); }
  [[nodiscard]] std::function<void()> Waker() override {
    return [this] { wakes.release(); };
  }
  [[nodiscard]] const std::string& protocol() const override { return name; }
  [[nodiscard]] WebRole role() const override { return its_role; }
  [[nodiscard]] std::optional<WebArrival> arrival() const override { return its_arrival; }

  std::optional<WebArrival> its_arrival;
  std::counting_semaphore<> wakes{0};
  bool is_slow = false;
  std::size_t waiting = 0;
  std::vector<Json> texts;
  std::vector<std::string> binaries;
  std::string closed;
  std::string name = "foxglove.websocket.v1";
  WebRole its_role = WebRole::kChange;
};

enum class Side { kLeft, kRight };
inline void Describe(TypeBuilder<Side>& type) {
  type.Name("Side").Value("left", Side::kLeft).Value("right", Side::kRight);
}
struct Hidden {};
inline void Describe(TypeBuilder<Hidden>& type) { type.Name("Hidden"); }

class Robot final : public Module {
 public:
  using Module::Module;
  Output<Pose2> pose{this, "pose"};
  Output<double> speed{this, "speed"};
  Output<RangeScan> scan{this, "scan"};
  Output<Hidden> hidden{this, "hidden"};
  Input<Point2> goal{this, "goal"};
  Input<double> limit{this, "limit"};
  Input<Hidden> secret{this, "secret"};
  Parameter<double> gain{this, "gain", {.default_value = 0.5, .bounds = {0.0, 2.0}, .unit = "1", .description = ""}};
  Parameter<int> count{this, "count", {.default_value = 3}};
  Parameter<bool> is_on{this, "is_on", {.default_value = true}};
  Parameter<Side> side{this, "side", {.default_value = Side::kLeft}};
  Parameter<Duration> patience{this, "patience", {.default_value = std::chrono::milliseconds(20)}};
  Parameter<Pose2> offset{this, "offset", {.default_value = {1, 2, 3}}};
  StaticParameter<std::string> title{this, "title", {.default_value = "R2"}};
  StaticParameter<std::vector<double>> weights{this, "weights", {.default_value = {0.5, 1}}};
  StaticParameter<std::vector<std::uint8_t>> bytes{this, "bytes", {.default_value = {1, 255}}};

 private:
  void Update() override {}
};

class FoxgloveTest : public testing::Test {
 protected:
  FoxgloveTest() {
    EXPECT_TRUE(runtime.MakeReady(application));
    runtime.set_clock(clock);
    clock.Set(Time(std::chrono::seconds(1)));
  }
  ~FoxgloveTest() override { session = nullptr; }

  void Begin(bool is_read_only = false) {
    FoxgloveApplication shown{.service = service,
                              .name = "demo",
                              .version = "1.2",
                              .is_read_only = is_read_only,
                              .drive_deadline = drive_deadline,
                              .steady_clock = &steady_clock};
    protocol = FoxgloveProtocol(std::move(shown));
    session = protocol.start(client);
    session->OnPoll();
  }

  void Say(const Json& message) { session->OnText(message.dump()); }
  void SayRaw(std::string_view text) { session->OnText(text); }
  /// Turns until `is_done` says so, or too long.
  bool Wait(const std::function<bool()>& is_done) {
    const auto latest = std::chrono::steady_clock::now() + kLongestWait;
    do {
      steady_clock.Advance(std::chrono::milliseconds(2));
      session->OnPoll();
      if (is_done()) return true;
      std::this_thread::yield();
    } while (std::chrono::steady_clock::now() < latest);
    return false;
  }
  void Turn() {
    steady_clock.Advance(std::chrono::milliseconds(120));  // until it looks at everything
    session->OnPoll();
  }

  /// All that has been said so with this operation, and forgets it.
  std::vector<Json> Take(const std::string& op) {
    std::vector<Json> taken;
    std::erase_if(client.texts, [&](const Json& each) {
      if (each["op"] != op) return false;
      taken.push_back(each);
      return true;
    });
    return taken;
  }
  /// The last complaint; "" if there is none.
  std::string Complaint() {
    const auto statuses = Take("status");
    return statuses.empty() ? "" : statuses.back()["message"].get<std::string>();
  }
  /// All channels that are advertised, by topic.
  std::map<std::string, Json> Channels() {
    for (const Json& message : Take("advertise")) {
      for (const Json& channel : message["channels"]) channels[channel["topic"]] = channel;
    }
    return channels;
  }
  std::uint32_t IdOf(const std::string& topic) { return Channels().at(topic)["id"]; }

  struct Value {
    std::uint32_t subscription;
    std::uint64_t timestamp;
    Json json;
  };
  /// The values that have come, and forgets them.
  std::vector<Value> TakeValues() {
    std::vector<Value> values;
    for (const std::string& bytes : client.binaries) {
      if (bytes[0] == 1) values.push_back({Number<4>(bytes, 1), Number<8>(bytes, 5), Json::parse(bytes.substr(13))});
    }
    client.binaries.clear();
    return values;
  }
  template <int size>
  static std::conditional_t<size == 4, std::uint32_t, std::uint64_t> Number(const std::string& bytes, std::size_t at) {
    using N = std::conditional_t<size == 4, std::uint32_t, std::uint64_t>;
    N number = 0;
    for (std::size_t i = size; i > 0; --i) {
      number = static_cast<N>(number << 8 | static_cast<unsigned char>(bytes.at(at + i - 1)));
    }
    return number;
  }
  void Publish(std::uint32_t channel, const std::string& json) {
    std::string bytes = "\x01";
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(channel >> (8 * i) & 0xff);
    session->OnBinary(bytes + json);
  }

  Runtime runtime;
  ManualClock clock;
  ManualClock steady_clock;
  ModuleRegistry modules;
  Group& application = runtime.Create<Group>(runtime.root(), "application");
  Robot& robot = runtime.Create<Robot>(application, "robot");
  StructureEditor editor{runtime, modules, nullptr};
  ApplicationLog log{runtime.clock()};
  CommandService service{{runtime, modules, editor, log}};
  Duration drive_deadline = std::chrono::minutes(1);
  FakeWebClient client;
  WebProtocol protocol;
  std::unique_ptr<WebSession> session;
  std::map<std::string, Json> channels;
};

}  // namespace runnel::test
