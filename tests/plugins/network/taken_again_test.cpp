// What is taken in another way, or comes again: as one, and as what it is.
#include <algorithm>
#include <atomic>
#include <optional>
#include <regex>

#include <gmock/gmock.h>

#include "plugins/ros_services/ros_time.h"
#include "plugins/wire/wire.h"
#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

/// An engine that counts the readers of /drive.
class ReaderCount final : public WireEngine {
 public:
  explicit ReaderCount(std::shared_ptr<WireEngine> engine) : engine_(std::move(engine)) {}
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override {
    auto joined = engine_->Join(options, discovery);
    if (!joined) return joined.error();
    return std::unique_ptr<WireParticipant>(std::make_unique<Participant>(std::move(*joined), *this));
  }
  [[nodiscard]] int made() const { return made_; }
  /// At once.
  [[nodiscard]] int most() const { return most_; }

 private:
  class Reader final : public WireReader {
   public:
    Reader(std::unique_ptr<WireReader> inner, std::atomic<int>& now) : inner_(std::move(inner)), now_(now) {}
    ~Reader() override {
      inner_.reset();
      --now_;
    }
    [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }

   private:
    std::unique_ptr<WireReader> inner_;
    std::atomic<int>& now_;
  };
  class Participant final : public WireParticipant {
   public:
    Participant(std::unique_ptr<WireParticipant> inner, ReaderCount& count) : inner_(std::move(inner)), count_(count) {}
    [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
    Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
      return inner_->MakeWriter(options, std::move(on_matched));
    }
    Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                   OnMatched on_matched) override {
      auto made = inner_->MakeReader(options, std::move(on_sample), std::move(on_matched));
      if (!made || options.topic != "rt/drive") return made;
      count_.most_ = std::max<int>(count_.most_, ++count_.now_);
      ++count_.made_;
      return std::unique_ptr<WireReader>(std::make_unique<Reader>(std::move(*made), count_.now_));
    }

   private:
    const std::unique_ptr<WireParticipant> inner_;
    ReaderCount& count_;
  };

  const std::shared_ptr<WireEngine> engine_;
  std::atomic<int> now_{0}, made_{0}, most_{0};
};

// An output has one publisher: a thread of the engine, which each reader may have one of its own of.
TEST(TakenAgainTest, WhatIsTakenInAnotherWayHasOneReaderAtATime) {
  ReaderCount engine(MakeFakeWire());
  Member robot(engine, "robot");
  robot.Take({.topic = "/drive"}, robot.module.goal);
  robot.Begin();
  WaitUntil("it is taken", [&] { return engine.made() == 1; });
  {
    // Before the network's thread can look.
    const std::lock_guard lock(robot.runtime.structure_mutex());
    Port& output = *robot.network->takes().front().output;
    ASSERT_TRUE(Port::Disconnect(output, robot.module.goal));
    ASSERT_TRUE(robot.network->AddTake({.topic = "/drive", .quality = ValueQuality::kLatched}, TypeOf<Place>()));
    ASSERT_TRUE(Port::Connect(output, robot.module.goal));
  }
  WaitUntil("it is taken in another way", [&] { return engine.made() == 2; });
  EXPECT_EQ(engine.most(), 1);
}

TEST(TakenAgainTest, WhoeverLooksThatTwoAreHeardIsLogged) {
  const std::shared_ptr<WireEngine> engine = MakeFakeWire();
  Member robot(*engine, "robot");
  robot.Take({.topic = "/drive"}, robot.module.goal);
  robot.Begin();
  Member one(*engine, "planner");
  Member other(*engine, "planner");
  for (Member* const each : {&one, &other}) {
    each->Offer({.port = "/application/module/place", .topic = "/drive"});
    each->Begin();
  }
  double x = 0;
  WaitUntil("it is shown", [&] {
    for (Member* const each : {&one, &other}) {
      each->module.place.Publish({++x, 0});
      WaitUntilQuiet(*engine);
    }
    return robot.Text().find("TWO MASTERS") != std::string::npos;
  });
  robot.WaitFor("planner and planner write it, and all of them are heard");
}

class SentAgainTest : public testing::TestWithParam<ValueQuality> {};

// Whoever offers sends the newest value again to who reads again: what has come before the link was lost is no command of now.
TEST_P(SentAgainTest, WhatCameBeforeALinkWasLostIsNotNewAfterwards) {
  const std::shared_ptr<WireEngine> engine = MakeFakeWire();
  Member planner(*engine, "planner");
  Member robot(*engine, "robot");
  planner.Offer({.port = "/application/module/place", .topic = "/drive", .quality = GetParam()});
  robot.Take({.topic = "/drive"}, robot.module.goal);
  planner.Begin();
  robot.Begin();
  const auto is_read = [&] { return IsConnected(planner.module.place); };
  WaitUntil("it is read", is_read);
  planner.module.place.Publish({7, 0});
  WaitUntil("it has come", [&] { return robot.module.goal.Get().x == 7; });
  ProbePort all(robot.runtime.root(), "all", TypeOf<Place>());
  {
    const std::lock_guard lock(robot.runtime.structure_mutex());
    ASSERT_TRUE(Port::Connect(*robot.network->takes().front().output, all));
  }
  while (all.Take([](const void*, ValueTimes) {})) {
  }
  const auto sent = [&] {
    const std::string text = planner.Text();
    std::smatch found;
    return std::regex_search(text, found, std::regex(", ([0-9]+) sent")) ? std::stoi(found[1]) : 0;
  };
  for (const bool has_other_handle : {true, false}) {
    const int before = sent();
    SetCutOff(*engine, "planner", true);
    WaitUntil("it is read no more", [&] { return !is_read(); });
    SetCutOff(*engine, "planner", false, has_other_handle);
    WaitUntil("it is read again", is_read);
    WaitUntil("it is sent again", [&] { return sent() > before; });
    WaitUntilQuiet(*engine);
    EXPECT_FALSE(all.Take([](const void*, ValueTimes) {}));
  }
  planner.module.place.Publish({8, 0});
  WaitUntil("what is new is heard", [&] { return robot.module.goal.Get().x == 8; });
}

INSTANTIATE_TEST_SUITE_P(Qualities, SentAgainTest, testing::Values(ValueQuality::kNewest, ValueQuality::kSensor));

/// Ends that are no application.
class PassedOverTest : public testing::Test {
 protected:
  struct Node {
    std::unique_ptr<WireParticipant> participant;
    std::unique_ptr<WireWriter> writer;
  };
  Node Make(const std::string& name, bool is_latched) {
    Node node{.participant = Must(engine_->Join({.name = name}, table_)), .writer = {}};
    node.writer = Must(node.participant->MakeWriter({.topic = "rt/drive",
                                                     .type = form_->codec->dds_type(),
                                                     .qos = {.is_latched = is_latched},
                                                     .user_data = form_->user_data},
                                                    {}));
    WaitUntilQuiet(*engine_);
    return node;
  }
  void Write(const Node& node, double x) {
    auto octets = std::make_shared<Octets>();
    form_->codec->Encode(std::make_unique<Place>(Place{x, 0}).get(), Time(), *octets);
    ASSERT_TRUE(node.writer->Write(octets, SinceEpoch().time_since_epoch().count()));
    WaitUntilQuiet(*engine_);
  }
  void BeginRobot() {
    robot_.Take({.topic = "/drive"}, robot_.module.goal);
    robot_.Begin();
    WaitUntilQuiet(*engine_);
  }
  void WaitUntilGone(const std::string& name) {
    WaitUntil(name + " has gone", [&] { return robot_.Text().find("by " + name) == std::string::npos; });
    WaitUntilQuiet(*engine_);
  }
  void WaitUntilItIs(const std::string& quality) {
    WaitUntil("it is " + quality, [&] { return robot_.Text().find("Place_, " + quality) != std::string::npos; });
    WaitUntilQuiet(*engine_);
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  DiscoveryTable table_{[] {}};
  const std::shared_ptr<const ValueForm> form_ = Must(ValueForm::Make(TypeOf<Place>(), "", ""));
  Member robot_{*engine_, "robot"};
};

// A viewer writes what is not latched, and the robot asks for no more, so that it is heard: what the planner keeps is not
// delivered, nor when the viewer has left: it is no command of now.
TEST_F(PassedOverTest, WhatALatchedWriterKeptBesideAnotherOneIsNotNewWhenThatLeaves) {
  std::optional<Node> planner = Make("planner", true);
  Write(*planner, 7);
  {
    const Node viewer = Make("viewer", false);
    BeginRobot();
    EXPECT_THAT(robot_.Text(), testing::HasSubstr("Place_, reliable, newest 1"));
  }
  WaitUntilGone("viewer");
  EXPECT_FALSE(robot_.module.goal.Read().has_value());
  // It stays so when the link to it is lost.
  SetCutOff(*engine_, "planner", true);
  WaitUntilGone("planner");
  SetCutOff(*engine_, "planner", false);
  WaitUntil("it is there again", [&] { return robot_.Text().find("by planner") != std::string::npos; });
  WaitUntilQuiet(*engine_);
  EXPECT_FALSE(robot_.module.goal.Read().has_value());
  Write(*planner, 8);
  WaitUntil("what it says afterwards is new", [&] { return robot_.module.goal.Get().x == 8; });
  // What one keeps that comes later is asked for, once the other one has gone.
  planner.reset();
  WaitUntilGone("planner");
  const Node another = Make("another", true);
  Write(another, 9);
  WaitUntil("another one is heard", [&] { return robot_.module.goal.Get().x == 9; });
  WaitUntilItIs("reliable, latched");
}

TEST_F(PassedOverTest, WhoIsLatchedIsHeardBesideAViewerAndAfterIt) {
  const Node planner = Make("planner", true);
  Write(planner, 4);
  BeginRobot();
  WaitUntilItIs("reliable, latched");
  WaitUntil("what it keeps is heard", [&] { return robot_.module.goal.Get().x == 4; });
  {
    const Node viewer = Make("viewer", false);
    WaitUntilItIs("reliable, newest 1");
    Write(viewer, 5);
    Write(planner, 6);
    Write(viewer, 5);
    WaitUntil("the viewer is heard", [&] { return robot_.module.goal.Get().x == 5; });
  }
  WaitUntilGone("viewer");
  EXPECT_EQ(robot_.module.goal.Get().x, 5);
  Write(planner, 8);
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 8; });
}

// As "/image" and "/image/compressed" of ROS 2.
TEST(NestedTopicsTest, ATopicThatBeginsWithAnotherOneDoesNotGoWithIt) {
  Runtime runtime;
  Group& group = runtime.Create<Group>(runtime.root(), "application");
  NetworkElement& network = runtime.Create<NetworkElement>(group, "network", NetworkOptions{});
  const auto take = [&](const std::string& topic) {
    const std::lock_guard lock(runtime.structure_mutex());
    return Must(network.AddTake({.topic = topic}, TypeOf<double>()));
  };
  Port* const image = take("/camera/image");
  Port* const small = take("/camera/image/small");
  EXPECT_EQ(image->path(), "/application/network/camera/image");
  ASSERT_EQ(small->path(), "/application/network/camera/image_/small");
  EXPECT_EQ(take("/camera")->path(), "/application/network/camera_");
  UnlistedElement gone;
  {
    const ChangeScope changes(runtime);
    gone = Must(network.DropTake(*image));
  }
  runtime.Destroy(std::move(gone));
  EXPECT_NE(small->life_cycle(), LifeCycle::kDeleted);
  EXPECT_EQ(take("/camera/image/small"), small);
}

}  // namespace
}  // namespace runnel::test
