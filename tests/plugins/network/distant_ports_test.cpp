// "//other/module/angle" where another type, or another unit, is wanted than the other application has.
#include "core/paths/distant_ports.h"

#include <numbers>
#include <optional>

#include <gmock/gmock.h>

#include "core/paths/late_connections.h"
#include "core/types/builtin_types.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class Giver final : public Module {
 public:
  using Module::Module;
  Output<double> angle{this, "angle", {.unit = "deg"}};
  Output<int> count{this, "count"};
  Output<Place> place{this, "place"};

 private:
  void Update() override {}
};

/// Another version of it.
class OtherGiver final : public Module {
 public:
  using Module::Module;
  Output<double> count{this, "count"};
  Output<double> place{this, "place"};

 private:
  void Update() override {}
};

class Taker final : public Module {
 public:
  using Module::Module;
  Input<double> angle{this, "angle", {.unit = "rad"}};
  Input<double> number{this, "number"};
  Input<double> second{this, "second"};
  Input<Signal> event{this, "event"};
  Input<std::string> text{this, "text"};
  Input<Place> spot{this, "spot"};

 private:
  void Update() override {}
};

template <typename ModuleType>
class Peer {
 public:
  Peer(WireEngine& engine, const std::string& name, const NetworkOptions& options = {})
      : engine_(engine), options_(options) {
    options_.member.name = name;
    network = &runtime.template Create<NetworkElement>(group, "network", options_);
    (void)runtime.MakeReady(runtime.root());
  }
  void Begin() {
    auto begun = NetworkLink::Start(group, *network, engine_, false);
    if (!begun) throw std::runtime_error(begun.error().ToString());
    link_ = std::move(*begun);
  }
  void End() { link_.reset(); }
  // As a file does, and a change.
  void Connect(const std::string& from, Port& to, ConnectOptions options = {}) {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto brought = BringDistantPort(from, to, options);
    if (!brought) throw std::runtime_error(brought.error().ToString());
    const auto [path, part] = SplitPortPath(from);
    options.part = part;
    const auto connected = LateConnections::Of(runtime).Add(path, to.path(), options);
    if (!connected) throw std::runtime_error(connected.error().ToString());
  }

  void Disconnect(const std::string& from, Port& to) {
    const std::lock_guard lock(runtime.structure_mutex());
    Port* const output = DistantPorts::FindIn(runtime.root())->Find(from);
    if (output == nullptr || !Port::Disconnect(*output, to)) throw std::runtime_error("is not connected");
  }

  /// What the first connection waits for; "" if none does.
  [[nodiscard]] std::string WaitsFor() {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto& all = LateConnections::Of(runtime).all();
    return all.empty() ? "" : all[0].waits_for.value_or("");
  }
  [[nodiscard]] std::string said() {
    FlushLog();
    const std::lock_guard lock(mutex_);
    return said_;
  }

  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), "application");
  ModuleType& module = runtime.Create<ModuleType>(group, "module");
  NetworkElement* network = nullptr;

 private:
  std::mutex mutex_;
  std::string said_;
  LogSink sink_{runtime, [this](const LogMessage& message) {
                  const std::lock_guard lock(mutex_);
                  said_ += message.text + "\n";
                }};
  WireEngine& engine_;
  NetworkOptions options_;
  std::unique_ptr<NetworkLink> link_;
};

const NetworkOptions kAll = {.offers = {{.patterns = {"module/*"}}}};

class DistantPortsTest : public testing::Test {
 protected:
  // Until all that is published has come where it is wanted.
  template <typename T, typename Port>
  T Next(const std::function<void()>& publish, Port& input) {
    std::optional<T> value;
    WaitUntil("a value comes", [&] {
      publish();
      if (const auto read = input.Read(); read.has_value()) value = *read;
      return value.has_value();
    });
    return *value;
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  Peer<Giver> giver_{*engine_, "giver", kAll};
  Peer<Taker> taker_{*engine_, "taker"};
};

TEST_F(DistantPortsTest, NumbersAreConvertedAsBetweenPortsOfOneApplication) {
  taker_.Connect("//giver/module/count", taker_.module.number);  // which are no doubles there
  taker_.Connect("//giver/module/count", taker_.module.text);
  taker_.Begin();
  giver_.Begin();
  const auto publish = [&] { giver_.module.count.Publish(7); };
  EXPECT_EQ(Next<double>(publish, taker_.module.number), 7);
  EXPECT_EQ(Next<std::string>(publish, taker_.module.text), "7");
}

TEST_F(DistantPortsTest, UnitsAreTold) {
  taker_.Connect("//giver/module/angle", taker_.module.angle);
  taker_.Begin();
  giver_.Begin();
  EXPECT_DOUBLE_EQ(Next<double>([&] { giver_.module.angle.Publish(180); }, taker_.module.angle), std::numbers::pi);
}

TEST_F(DistantPortsTest, WhatTakesAnythingWaitsUntilItIsKnownOfWhichType) {
  taker_.Connect("//giver/module/angle", taker_.module.event);
  const LateConnections& late = LateConnections::Of(taker_.runtime);
  ASSERT_EQ(late.all().size(), 1U);
  EXPECT_TRUE(late.all()[0].waits_for.has_value());
  taker_.Begin();
  giver_.Begin();
  (void)Next<Signal>([&] { giver_.module.angle.Publish(1); }, taker_.module.event);
}

TEST_F(DistantPortsTest, OneThatCannotBeMadeSaysWhy) {
  taker_.Connect("//giver/module/place.z", taker_.module.number);
  taker_.Connect("//giver/module/count", taker_.module.text, {.convert = "nonsense"});
  EXPECT_THAT(taker_.WaitsFor(), HasSubstr("the network does not run"));
  taker_.Begin();
  EXPECT_THAT(taker_.WaitsFor(), HasSubstr("giver is not in the network yet"));
  giver_.Begin();
  WaitUntil("it is told", [&] { return taker_.WaitsFor().find("'z'") != std::string::npos; });
  WaitUntil("that is told, too", [&] { return taker_.said().find("nonsense") != std::string::npos; });
  EXPECT_THAT(taker_.said(), HasSubstr("waits for //giver/module/place.z: "));
}

TEST_F(DistantPortsTest, PartsOfOnePortAreOfOneOutput) {
  taker_.Connect("//giver/module/place.x", taker_.module.number);
  taker_.Connect("//giver/module/place.y", taker_.module.second);
  taker_.Begin();
  giver_.Begin();
  const auto publish = [&] { giver_.module.place.Publish({3, 4}); };
  EXPECT_EQ(Next<double>(publish, taker_.module.number), 3);
  EXPECT_EQ(Next<double>(publish, taker_.module.second), 4);
  const std::lock_guard lock(taker_.runtime.structure_mutex());
  ASSERT_EQ(taker_.network->takes().size(), 1U);
  EXPECT_EQ(taker_.network->takes()[0].output->outgoing().size(), 2U);
  EXPECT_THAT(LateConnections::Of(taker_.runtime).all(), IsEmpty());
}

TEST_F(DistantPortsTest, WhoComesBackWithAnotherTypeIsHeardIfAllCanBecomeWhatIsWanted) {
  auto giver = std::make_unique<Peer<Giver>>(*engine_, "first", kAll);
  taker_.Connect("//first/module/count", taker_.module.number);
  taker_.Connect("//first/module/count", taker_.module.text);
  taker_.Connect("//first/module/place.x", taker_.module.second);
  taker_.Begin();
  giver->Begin();
  const auto publish = [&] {
    giver->module.count.Publish(7);
    giver->module.place.Publish({1, 2});
  };
  EXPECT_EQ(Next<double>(publish, taker_.module.number), 7);
  EXPECT_EQ(Next<double>(publish, taker_.module.second), 1);
  giver.reset();
  {
    Peer<OtherGiver> other(*engine_, "first", kAll);
    other.Begin();
    std::string text;
    WaitUntil("it is 0.5", [&] {
      other.module.count.Publish(0.5);
      other.module.place.Publish(9);
      if (const auto read = taker_.module.text.Read(); read.has_value()) text = *read;
      return taker_.module.number.Get() == 0.5 && text == "0.5";
    });
    const std::string told = "has values of another type there: /application/module/input/second: ";
    WaitUntil("it is told", [&] { return taker_.said().find(told) != std::string::npos; });
  }
  giver = std::make_unique<Peer<Giver>>(*engine_, "first", kAll);
  giver->Begin();
  WaitUntil("it is as before", [&] {
    giver->module.place.Publish({5, 6});
    giver->module.count.Publish(8);
    return taker_.module.second.Get() == 5 && taker_.module.number.Get() == 8;
  });
}

TEST_F(DistantPortsTest, AnOutputThatNobodyUsesAnyMoreMakesRoomForOneOfAnotherType) {
  taker_.Connect("//giver/module/place", taker_.module.number);  // nobody has told of which type it is
  taker_.Disconnect("//giver/module/place", taker_.module.number);
  taker_.Connect("//giver/module/place", taker_.module.spot);
  taker_.Begin();
  giver_.Begin();
  EXPECT_EQ(Next<Place>([&] { giver_.module.place.Publish({3, 4}); }, taker_.module.spot).y, 4);
  const std::lock_guard lock(taker_.runtime.structure_mutex());
  EXPECT_EQ(taker_.network->takes().size(), 1U);
}

TEST_F(DistantPortsTest, WhatIsNotOfferedIsToldOfWhatIsConnectedOnly) {
  Peer<Giver> robot(*engine_, "my-robot", kAll);
  taker_.Connect("//my-robot/module/plase", taker_.module.number);
  taker_.Connect("//my-robot/runnel_structur", taker_.module.second);
  taker_.Connect("//my-robot/module/kount", taker_.module.spot);
  taker_.Disconnect("//my-robot/module/kount", taker_.module.spot);
  taker_.Begin();
  robot.Begin();
  WaitUntil("both are told", [&] {
    const std::string said = taker_.said();
    return said.find("my-robot offers no //my_robot/module/plase; did you mean '//my_robot/module/place'?") !=
               std::string::npos &&
           said.find("my-robot offers no //my_robot/runnel_structur") != std::string::npos;
  });
  EXPECT_THAT(taker_.said(),
              testing::AllOf(testing::Not(HasSubstr("runnel_structure")), testing::Not(HasSubstr("kount"))));
}

TEST_F(DistantPortsTest, ANetworkThatEndsLeavesWhatIsConnected) {
  taker_.Connect("//giver/module/place.x", taker_.module.number);
  taker_.Begin();
  giver_.Begin();
  EXPECT_EQ(Next<double>([&] { giver_.module.place.Publish({3, 4}); }, taker_.module.number), 3);
  taker_.End();
  taker_.Connect("//giver/module/angle", taker_.module.angle);
  EXPECT_THAT(taker_.WaitsFor(), HasSubstr("the network does not run"));
  taker_.Begin();
  EXPECT_EQ(Next<double>([&] { giver_.module.angle.Publish(0); }, taker_.module.angle), 0);
  WaitUntil("the part comes again", [&] {
    giver_.module.place.Publish({8, 4});
    return taker_.module.number.Get() == 8;
  });
}

}  // namespace
}  // namespace runnel::test
