// An engine that does not match, or fails, for reasons of its own.
#include <atomic>
#include <new>

#include <gmock/gmock.h>

#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class FailingEngine final : public WireEngine {
 public:
  explicit FailingEngine(std::shared_ptr<WireEngine> engine) : engine_(std::move(engine)) {}
  Result<std::unique_ptr<WireParticipant>> Join(const WireMemberOptions& options, WireDiscovery& discovery) override {
    auto joined = engine_->Join(options, discovery);
    if (!joined) return joined.error();
    return std::unique_ptr<WireParticipant>(std::make_unique<Participant>(std::move(*joined), *this));
  }

  std::atomic<bool> matches{true};        // those that are made from then on
  std::atomic<bool> lacks_memory{false};  // for readers of /drive
  std::atomic<int> failures{0};

 private:
  class Writer final : public WireWriter {
   public:
    explicit Writer(std::unique_ptr<WireWriter> inner) : inner_(std::move(inner)) {}
    [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
    [[nodiscard]] bool HasReader(std::uint64_t) const override { return false; }
    Result<void> Write(const std::shared_ptr<const Octets>&, std::int64_t) override { return {}; }

   private:
    const std::unique_ptr<WireWriter> inner_;
  };
  class Participant final : public WireParticipant {
   public:
    Participant(std::unique_ptr<WireParticipant> inner, FailingEngine& engine)
        : inner_(std::move(inner)), engine_(engine) {}
    [[nodiscard]] const WireId& id() const noexcept override { return inner_->id(); }
    Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
      if (engine_.matches) return inner_->MakeWriter(options, std::move(on_matched));
      return std::unique_ptr<WireWriter>(std::make_unique<Writer>(Must(inner_->MakeWriter(options, {}))));
    }
    Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                   OnMatched on_matched) override {
      if (engine_.lacks_memory && options.topic == "rt/drive") {
        ++engine_.failures;
        throw std::bad_alloc();
      }
      return inner_->MakeReader(options, std::move(on_sample), engine_.matches ? std::move(on_matched) : OnMatched());
    }

   private:
    const std::unique_ptr<WireParticipant> inner_;
    FailingEngine& engine_;
  };

  const std::shared_ptr<WireEngine> engine_;
};

class FailingEngineTest : public testing::Test {
 protected:
  void BeginRobot() {
    robot_.Offer({.port = "/application/module/place", .topic = "/place"});
    robot_.Take({.topic = "/drive"}, robot_.module.goal);
    robot_.Begin();
  }
  void BeginPlanner(ValueQuality quality = ValueQuality::kLatched) {
    planner_.Offer({.port = "/application/module/place", .topic = "/drive", .quality = quality});
    planner_.Take({.topic = "/place"}, planner_.module.goal);
    planner_.Begin();
  }

  const std::shared_ptr<WireEngine> inner_ = MakeFakeWire();
  FailingEngine engine_{inner_};
  Member robot_{engine_, "robot"};
  Member planner_{*inner_, "planner"};
};

// For want of a word from it, as where a policy differs that discovery does not tell of.
TEST_F(FailingEngineTest, WhomItDoesNotMatchIsToldOfInBothDirections) {
  engine_.matches = false;
  BeginRobot();
  BeginPlanner();
  const auto is_known = [&](const std::string& word) {
    return robot_.Text().find(word + " by planner") != std::string::npos;
  };
  WaitUntil("both are known", [&] { return is_known("written") && is_known("read"); });
  const std::string why = R"(\): not matched \(yet\), for a reason that it does not say)";
  EXPECT_THAT(robot_.Text(), AllOf(ContainsRegex("    written by planner \\([a-z, 0-9]*" + why),
                                   ContainsRegex("    read by planner \\([a-z, 0-9]*" + why)));
}

TEST_F(FailingEngineTest, OfWhomItMatchesNothingOfTheKindIsSaid) {
  BeginRobot();
  BeginPlanner();
  WaitUntil("both are matched", [&] {
    const auto& taken = robot_.Text();
    return IsConnected(robot_.module.place) && taken.find("written by planner (") != std::string::npos &&
           taken.find("not matched") == std::string::npos;
  });
  WaitUntilQuiet(*inner_);
  EXPECT_THAT(robot_.Text(), Not(HasSubstr("not matched")));
}

// Nobody tells again what has changed. A reader of another quality is to be made, as what is there does not fit the writer.
TEST_F(FailingEngineTest, WhatItHadNoMemoryForIsTriedAgainAndNotWithoutAPause) {
  BeginRobot();
  WaitUntilQuiet(*inner_);
  engine_.lacks_memory = true;
  BeginPlanner(ValueQuality::kSensor);
  planner_.module.place.Publish({7, 0});
  robot_.WaitFor("the network: ");
  WaitUntilQuiet(*inner_);
  const Time begun = SteadyClock().Now();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // whatever else there was to be looked at
  EXPECT_LE(engine_.failures, 20 + (SteadyClock().Now() - begun) / std::chrono::milliseconds(100));
  EXPECT_FALSE(robot_.module.goal.Read().has_value());
  robot_.module.place.Publish({3, 0});
  WaitUntil("what it offers is sent meanwhile", [&] { return planner_.module.goal.Get().x == 3; });
  EXPECT_FALSE(robot_.module.goal.Read().has_value());
  engine_.lacks_memory = false;
  WaitUntil("it is heard", [&] { return robot_.module.goal.Get().x == 7; });
}

}  // namespace
}  // namespace runnel::test
