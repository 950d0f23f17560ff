#include "plugins/behaviours/behaviour_group.h"

#include <gmock/gmock.h>

#include "core/element/runtime.h"

namespace runnel {
namespace {

using ::testing::HasSubstr;

class Doer final : public Behaviour {
 public:
  using Behaviour::Behaviour;

 private:
  std::optional<Outcome> Behave(double activation) override { return Outcome{activation, 1.0}; }
};

class Team final : public BehaviourGroup {
 public:
  using BehaviourGroup::BehaviourGroup;
  Doer first{{*this, "first"}};
  Doer second{{*this, "second"}};
  Result<void> again;

 private:
  Result<void> Construct() override {
    if (auto set = first.inhibitions.Set(2); !set) return set;
    if (auto made = Characterise(first); !made) return made;
    again = Characterise(second);
    return {};
  }
};

TEST(BehaviourGroupTest, HasTheSignalsOfItsCharacteristicBehaviour) {
  Runtime runtime;
  auto& team = runtime.Create<Team>(runtime.root(), "team");
  ASSERT_TRUE(Runtime::Construct(team));
  EXPECT_EQ(CharacteristicOf(team), &team.first);
  EXPECT_TRUE(CheckBehaviourGroup(team, "first"));
  EXPECT_NE(team.FindChild("inhibition2"), nullptr);
  EXPECT_EQ(team.FindChild("inhibition3"), nullptr);
  Output<Stimulation> wanted(runtime.root(), "wanted");
  ASSERT_TRUE(Port::Connect(wanted, dynamic_cast<Port&>(*team.FindChild("stimulation"))));
  wanted.Publish(Stimulation(0.5));
  EXPECT_EQ(team.first.stimulation.Get().value(), 0.5);
  auto& mode = dynamic_cast<Configurable&>(*team.FindChild("stimulation_mode"));
  ASSERT_TRUE(mode.SetFromText("disabled"));
  EXPECT_EQ(team.first.stimulation_mode.Get(), StimulationMode::kDisabled);
  EXPECT_EQ(team.second.stimulation_mode.Get(), StimulationMode::kAuto);
}

TEST(BehaviourGroupTest, OneSpeaksForIt) {
  Runtime runtime;
  auto& team = runtime.Create<Team>(runtime.root(), "team");
  ASSERT_TRUE(Runtime::Construct(team));
  ASSERT_FALSE(team.again);
  EXPECT_THAT(team.again.error().message, HasSubstr("'first' speaks for it already"));
}

TEST(BehaviourGroupTest, KnowsItsCharacteristicBehaviourByAnotherName) {
  Runtime runtime;
  auto& team = runtime.Create<Team>(runtime.root(), "team");
  ASSERT_TRUE(Runtime::Construct(team));
  team.Annotate(std::make_unique<CharacteristicBehaviour>("as_it_was_called"));
  EXPECT_EQ(CharacteristicOf(team), &team.first);
}

TEST(BehaviourGroupTest, TellsWhatIsMissing) {
  Runtime runtime;
  auto& group = runtime.Create<Group>(runtime.root(), "group");
  EXPECT_EQ(CharacteristicOf(group), nullptr);
  EXPECT_THAT(CheckBehaviourGroup(group, "doer").error().message, HasSubstr("'doer' is not there"));
  auto& doer = runtime.Create<Doer>(group, "doer");
  ASSERT_TRUE(Runtime::Construct(doer));
  const Error error = CheckBehaviourGroup(group, "doer").error();
  EXPECT_THAT(error.message, HasSubstr("has no interface port 'stimulation'"));
  EXPECT_THAT(error.hint, HasSubstr("<port name=\"stimulation\" direction=\"input\"/>"));
}

}  // namespace
}  // namespace runnel
