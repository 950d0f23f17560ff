// Parameters that an output has set, a STOP included, where changes are taken back and modules fail.

#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "plugins/structure/value_by_hand.h"
#include "tests/plugins/application_tags/made_again_fixture.h"

namespace runnel::testing {
namespace {

/// By which readers of the source find 0 from then on, and nothing comes that is new.
class Halted : public MadeAgain, public ::testing::WithParamInterface<std::string> {
 protected:
  void Halt() {
    if (GetParam() == "stop") {
      ASSERT_TRUE(workshop_.runtime.robot_stop().Press("a test"));
    } else if (GetParam() == "block") {
      ASSERT_TRUE(Output().Block());
    } else if (GetParam() == "hand") {
      const double value = 0;
      const std::lock_guard lock(workshop_.runtime.structure_mutex());
      ASSERT_TRUE(PublishByHand(Output(), &value));
    } else {
      Say(0);
    }
  }
  // They find 2 again.
  void Resume() {
    (void)workshop_.runtime.robot_stop().Release("a test");
    Output().Unblock();
    Output().Release();
    Run();
    Say(2);
    EXPECT_EQ(Run(), 2);
  }
  // A module that has taken the place throws, after `meanwhile`.
  void Fail(const std::function<void()>& meanwhile) {
    Do({ReplaceModule{"/demo/other", "test/fragile", {}, 1000}});
    meanwhile();
    EXPECT_EQ(Run(), 2);
    Halt();
    EXPECT_EQ(Run(), 0);
    Fragile::throws = true;
    Run();
    const auto faults = scheduler_->TakeFaults();
    ASSERT_NE(dynamic_cast<Source*>(*workshop_.runtime.root().Find("/demo/other")), nullptr)
        << (faults.empty() ? "" : faults.front().message);
    EXPECT_EQ(Run(), 0);
    EXPECT_FALSE(Output().outgoing().empty());
  }
};
INSTANTIATE_TEST_SUITE_P(, Halted, ::testing::Values("stop", "block", "hand", "published"),
                         [](const auto& given) { return given.param; });

TEST_P(Halted, IsNotTakenBackWithAChange) {
  const std::vector<std::pair<ChangeSet, std::string>> all{
      {{ReplaceModule{"/demo/other", "test/source"}}, "other"},
      {{SetParameter{"/demo/other/text", "static"}}, "other"},
      {{RenameElement{"/demo/other", "another"}}, "another"},
      {{DisconnectPorts{"/demo/source/value", "/demo/other/gain"}, ReplaceModule{"/demo/other", "test/source"},
        ConnectPorts{"/demo/source/value", "/demo/other/gain"}},
       "other"}};
  Start(kConnected);
  for (const auto& [changes, name] : all) {
    Resume();
    const std::string renamed = "/demo/" + name + "/parameter/gain";
    ASSERT_TRUE(history_->Apply(changes));
    EXPECT_EQ(Run(renamed), 2);
    Halt();
    EXPECT_EQ(Run(renamed), 0);
    for (int round = 0; round < 2; ++round) {
      ASSERT_TRUE(history_->Undo());
      EXPECT_EQ(Run(), 0) << round;
      ASSERT_TRUE(history_->Redo());
      EXPECT_EQ(Run(renamed), 0) << round;
    }
    ASSERT_TRUE(history_->Undo());
  }
}

TEST_P(Halted, IsNotTakenBackWithASetting) {
  Start(kConnected);
  const std::vector<ChangeSet> all{{SetParameter{"/demo/other/gain", "5"}},
                                   {ReplaceModule{"/demo/other", "test/source", {{"gain", "5"}}}}};
  for (const ChangeSet& changes : all) {
    Resume();
    ASSERT_TRUE(history_->Apply(changes));
    EXPECT_EQ(Run(), 5);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 2) << "nothing has come since";
    ASSERT_TRUE(history_->Redo());
    EXPECT_EQ(Run(), 5);
    Halt();
    EXPECT_EQ(Run(), 0);
    ASSERT_TRUE(history_->Undo());
    EXPECT_EQ(Run(), 0);
  }
}

TEST_P(Halted, IsNotTakenBackWithAModuleThatHasFailed) {
  Start(kConnected);
  Say(2);
  EXPECT_EQ(Run(), 2);
  Fail([] {});
}

TEST_P(Halted, IsNotTakenBackThoughConnectedToTheModuleThatHasFailed) {
  Start(kOther);
  Do({SetParameter{"/demo/other/gain", "5"}});
  Say(2);
  EXPECT_EQ(Run(), 5);
  Fail([this] { Do({ConnectPorts{"/demo/source/value", "/demo/other/gain"}}); });
}

}  // namespace
}  // namespace runnel::testing
