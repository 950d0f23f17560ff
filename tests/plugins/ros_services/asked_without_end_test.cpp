// Who asks again as soon as there is an answer keeps nobody else from being served, and nothing from ending.

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/lockfree/wake_event.h"
#include "core/log/logger.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/parameters/parameter.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/offered_service.h"
#include "plugins/ros_services/parameter_services.h"
#include "plugins/services/service.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

constexpr int kWithoutEnd = 20000;

/// A member of a network of which there is nothing but who asks, in the thread that has answered.
class Asking final : public WireParticipant {
 public:
  [[nodiscard]] const WireId& id() const noexcept override { return id_; }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched) override {
    return std::unique_ptr<WireWriter>(std::make_unique<Writer>(*this, options.topic));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                 OnMatched) override {
    readers_[options.topic] = std::move(on_sample);
    return std::unique_ptr<WireReader>(std::make_unique<Reader>());
  }
  void Ask(const std::string& service, const Octets& message) {
    const Octets request = WithCallId({.client = {1}, .number = ++number_, .writer = 0}, message);
    readers_.at(DdsRequestTopic(service))({.octets = request, .writer = 5});
  }
  template <typename T>
  void Ask(const std::string& service, const T& request) {
    Octets message;
    WriteCdr(TypeOf<T>(), &request, message);
    Ask(service, message);
  }

  std::function<void(const std::string& topic)> on_answer;

 private:
  struct Writer final : WireWriter {
    Writer(Asking& by, std::string on) : asking(by), topic(std::move(on)) {}
    [[nodiscard]] const WireId& id() const noexcept override { return asking.id_; }
    [[nodiscard]] bool HasReader(std::uint64_t) const override { return true; }
    Result<void> Write(const std::shared_ptr<const Octets>&, std::int64_t) override {
      if (asking.on_answer) asking.on_answer(topic);
      return {};
    }
    Asking& asking;
    const std::string topic;
  };
  struct Reader final : WireReader {
    [[nodiscard]] const WireId& id() const noexcept override { return own; }
    WireId own{4};
  };
  const WireId id_{3};
  std::atomic<std::int64_t> number_{0};
  std::map<std::string, OnSample> readers_;
};

class Wheels final : public Module {
 public:
  using Module::Module;
  Parameter<double> speed{this, "speed", {.default_value = 1}};

 private:
  void Update() override {}
};

class AskedWithoutEnd : public testing::Test {
 protected:
  AskedWithoutEnd() {
    runtime_.Create<Wheels>(robot_, "wheels");
    (void)runtime_.MakeReady(runtime_.root());
  }
  void Begin(ParameterSetter set) {
    services_ =
        std::move(*ParameterServices::Start(robot_, "/base", asking_, ServiceDialect::kInFront, std::move(set), log_));
  }

  Runtime runtime_;
  Group& robot_ = runtime_.Create<Group>(runtime_.root(), "robot");
  Logger log_{robot_};
  Asking asking_;
  std::unique_ptr<ParameterServices> services_;
};

TEST_F(AskedWithoutEnd, TheOtherParametersServicesHaveTheirTurnAndEnd) {
  std::atomic<int> lists{0};
  std::atomic<bool> has_got{false};
  asking_.on_answer = [&](const std::string& topic) {
    if (topic == DdsReplyTopic("/base/get_parameters")) has_got = true;
    if (topic == DdsReplyTopic("/base/list_parameters") && ++lists < kWithoutEnd)
      asking_.Ask("/base/list_parameters", RosListRequest());
  };
  Begin({});
  asking_.Ask("/base/list_parameters", RosListRequest());
  asking_.Ask("/base/get_parameters", std::vector<std::string>{"wheels.speed"});
  WaitUntil("it has its turn", [&] { return has_got.load(); });
  services_.reset();
  EXPECT_LT(lists, kWithoutEnd);
}

TEST_F(AskedWithoutEnd, OfManyParametersNotAllAreSetWhenTheApplicationEnds) {
  std::atomic<int> sets{0};
  Begin([&](const std::vector<ParameterChange>&) -> Result<void> {
    ++sets;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // as until its cycle has ended
    return {};
  });
  RosParameterValue value;
  value.type = RosParameterType::kDouble;
  const std::vector<RosParameter> wanted(900, {"wheels.speed", value});
  asking_.Ask("/base/set_parameters", wanted);
  WaitUntil("it has begun", [&] { return sets > 0; });
  services_.reset();
  EXPECT_LT(sets, 900);
}

TEST_F(AskedWithoutEnd, MoreParametersThanABoundAreSetTogetherOrNotAtAll) {
  int sets = 0;
  Begin([&](const std::vector<ParameterChange>&) -> Result<void> {
    ++sets;
    return {};
  });
  RosParameterValue value;
  value.type = RosParameterType::kDouble;
  const std::vector<RosParameter> wanted(1001, {"wheels.speed", value});
  const auto results = services_->Set(wanted, SteadyClock().Now());
  ASSERT_EQ(results.size(), wanted.size());
  EXPECT_FALSE(results.front().successful);
  EXPECT_THAT(results.back().reason, testing::HasSubstr("at most 1000"));
  EXPECT_EQ(sets, 0);
  EXPECT_TRUE(services_->SetAtomically(wanted, SteadyClock().Now()).successful);
  EXPECT_EQ(sets, 1);
}

struct Halver {
  int Half(const int& number) { return number / 2; }
};

TEST_F(AskedWithoutEnd, TheNetworksThreadHasItsTurn) {
  Halver halver;
  Service<int(int)> service(robot_, halver, "half", &Halver::Half);
  int answers = 0;
  OfferedService offered(runtime_, {.port = "/robot/half", .service = "/half"}, MessageLibrary::Standard(),
                         ServiceDialect::kInFront, 2, std::make_shared<WakeEvent>());
  const Octets wrong(5);  // which is answered at once
  asking_.on_answer = [&](const std::string&) {
    if (++answers < kWithoutEnd) asking_.Ask("/half", wrong);
  };
  ASSERT_TRUE(offered.Follow(asking_, [](std::uint64_t) { return true; }));
  asking_.Ask("/half", wrong);
  (void)offered.Work();
  EXPECT_EQ(answers, 1);
  (void)offered.Work();
  EXPECT_EQ(answers, 2);
}

}  // namespace
}  // namespace runnel::test
