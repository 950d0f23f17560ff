#include "core/module/group_parameter.h"

#include <memory>
#include <stdexcept>

#include "core/module/kept_state.h"
#include "plugins/structure/change_history.h"
#include "tests/plugins/structure/editor_fixture.h"

namespace runnel::test {
namespace {

class GroupParameterTest : public EditorTest {
 protected:
  GroupParameterTest() {
    Must({CreateGroup{"/app/group"}, CreateModule{"/app/group/left", "test/counter"},
          CreateModule{"/app/group/right", "test/counter"},
          CreateParameter{"/app/group/step", {"left/step", "right/step"}, "of both"},
          CreateParameter{"/app/group/label", {"left/label"}}});
  }
  int Step(const std::string& side) { return At<Counter>("/app/group/" + side).step.Get(); }
  std::string Label() { return At<Counter>("/app/group/left").label.Get(); }
  ChangeHistory history_{editor};
};

TEST_F(GroupParameterTest, SetsAllThatItStandsFor) {
  ASSERT_TRUE(history_.Apply({SetParameter{"/app/group/step", "7"}}));
  EXPECT_EQ(Step("left"), 7);
  EXPECT_EQ(Step("right"), 7);
  const auto& parameter = At<GroupParameter>("/app/group/step");
  EXPECT_EQ(parameter.ToText(), "7");
  EXPECT_EQ(&parameter.type(), &TypeOf<int>());
  EXPECT_EQ(parameter.info().description, "of both");
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(Step("left"), 1);
  EXPECT_EQ(Step("right"), 1);
}

TEST_F(GroupParameterTest, StandsForWhatIsNamedWithoutTheApplication) {
  Must({CreateParameter{"/group/other", {"/group/left/step", "/app/group/right/parameter/step"}},
        CreateParameter{"/app/both", {"/group/left/step"}}, CreateGroup{"/app/group/inner"},
        CreateParameter{"/app/group/inner/outer", {"/group/right/step"}}});
  EXPECT_THAT(At<GroupParameter>("/app/group/other").targets(), ElementsAre("left/step", "right/step"));
  EXPECT_THAT(At<GroupParameter>("/app/group/inner/outer").targets(), ElementsAre("/app/group/right/step"));
  Must({SetParameter{"/app/group/other", "5"}});
  EXPECT_EQ(Step("left"), 5);
  EXPECT_EQ(Step("right"), 5);
  EXPECT_EQ(At<GroupParameter>("/app/both").ToText(), "5");
  EXPECT_EQ(At<GroupParameter>("/app/group/inner/outer").ToText(), "5");
  Must({RenameElement{"/app/group", "pair"}});
  Must({SetParameter{"/app/both", "6"}, SetParameter{"/app/pair/other", "7"}, SetParameter{"/app/both", "6"}});
  EXPECT_EQ(At<Counter>("/app/pair/left").step.Get(), 6);
  EXPECT_EQ(At<Counter>("/app/pair/right").step.Get(), 7);
  Must({SetParameter{"/app/pair/inner/outer", "8"}});
  EXPECT_EQ(At<Counter>("/app/pair/right").step.Get(), 8) << "what stands for something outside of its group, too";
}

TEST_F(GroupParameterTest, FollowsEachOfSeveralNamesOfOneChangeSet) {
  Must({CreateParameter{"/app/both", {"/group/left/step"}}});
  const auto id = At<GroupParameter>("/app/both").id();
  ASSERT_TRUE(history_.Apply({RenameElement{"/app/group", "pair"}, RenameElement{"/app/pair/left", "front"},
                              RenameElement{"/app/pair/right", "back"}}));
  EXPECT_THAT(At<GroupParameter>("/app/both").targets(), ElementsAre("pair/front/step"));
  EXPECT_THAT(At<GroupParameter>("/app/pair/step").targets(), ElementsAre("front/step", "back/step"));
  EXPECT_EQ(At<GroupParameter>("/app/both").id(), id);
  ASSERT_TRUE(history_.Undo());
  EXPECT_THAT(At<GroupParameter>("/app/both").targets(), ElementsAre("group/left/step"));
  EXPECT_THAT(At<GroupParameter>("/app/group/step").targets(), ElementsAre("left/step", "right/step"));
  Must({SetParameter{"/app/both", "6"}});
  EXPECT_EQ(Step("left"), 6);
}

TEST_F(GroupParameterTest, SetsWhatItStandsForByThenWhereNamesAreExchanged) {
  Must({CreateParameter{"/app/both", {"/group/left/step"}}});
  ASSERT_TRUE(history_.Apply({RenameElement{"/app/group/left", "other"}, RenameElement{"/app/group/right", "left"},
                              RenameElement{"/app/group/other", "right"}, SetParameter{"/app/both", "7"}}));
  EXPECT_THAT(At<GroupParameter>("/app/both").targets(), ElementsAre("group/right/step"));
  EXPECT_EQ(Step("right"), 7);
  EXPECT_EQ(Step("left"), 1);
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(Step("left"), 1) << "it had not been set";
  EXPECT_EQ(Step("right"), 1);
  Must({ReplaceModule{"/app/group/left", "test/other_counter"}, SetParameter{"/app/both", "8"}});
  EXPECT_EQ(Step("left"), 8) << "what takes its place stands there, too";
}

TEST_F(GroupParameterTest, IsMadeAgainAfterWhatItStandsFor) {
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/group/left"}}));
  ASSERT_TRUE(history_.Undo());
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/group"}}));
  ASSERT_TRUE(history_.Undo());
  Must({SetParameter{"/app/group/step", "8"}});
  EXPECT_EQ(Step("left"), 8);
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/group/left"}}));
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/group"}}));
  ASSERT_TRUE(history_.Undo()) << "also if some of that has gone";
  EXPECT_EQ(Step("right"), 8);
  ASSERT_TRUE(history_.Undo());
  EXPECT_THAT(At<GroupParameter>("/app/group/step").Find(), testing::SizeIs(2));
}

TEST_F(GroupParameterTest, HasItsPathsAgainWhereALaterRenameFails) {
  At<Counter>("/app/group/right").Annotate(std::make_unique<BeforeHandOver>([]() -> BeforeHandOver::Held {
    throw std::runtime_error("what is under way does not end");
  }));
  EXPECT_FALSE(history_.Apply({RenameElement{"/app/group/left", "front"}, RenameElement{"/app/group/right", "back"}}));
  EXPECT_THAT(At<GroupParameter>("/app/group/step").targets(), ElementsAre("left/step", "right/step"));
}

TEST_F(GroupParameterTest, AllOrNothing) {
  EXPECT_THAT(Refusal({SetParameter{"/app/group/step", "many"}}), HasSubstr("no whole number"));
  EXPECT_THAT(Refusal({CreateParameter{"/app/group/more", {"left/stap"}}}), HasSubstr("did you mean 'step'?"));
  EXPECT_THAT(Refusal({CreateParameter{"/app/group/more", {"left/out"}}}), HasSubstr("no 'out' in /app/group/left"));
}

TEST_F(GroupParameterTest, OfAStaticOneMakesTheModuleAnew) {
  Steps(2);
  const auto before = At<Counter>("/app/group/left").id();
  ASSERT_TRUE(history_.Apply({SetParameter{"/app/group/label", "front"}}));
  EXPECT_EQ(Label(), "front");
  EXPECT_NE(At<Counter>("/app/group/left").id(), before);
  EXPECT_EQ(At<Counter>("/app/group/left").count.value, 2) << "and it goes on where it was";
  ASSERT_TRUE(history_.Undo());
  EXPECT_EQ(Label(), "none");
}

TEST_F(GroupParameterTest, OutlivesSwapsOfWhatItStandsFor) {
  Must({ReplaceModule{"/app/group/left", "test/other_counter"}, DeleteElement{"/app/group/right"}});
  Must({SetParameter{"/app/group/step", "3"}});
  EXPECT_EQ(Step("left"), 3);
  Must({DeleteElement{"/app/group/left"}});
  EXPECT_THAT(Refusal({SetParameter{"/app/group/step", "4"}}), HasSubstr("nothing is there any more"));
}

TEST_F(GroupParameterTest, ComesBackWithItsGroup) {
  Must({SetParameter{"/app/group/step", "7"}});
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/group"}}));
  ASSERT_TRUE(history_.Undo());
  Must({SetParameter{"/app/group/step", "8"}});
  EXPECT_EQ(Step("right"), 8);
  ASSERT_TRUE(history_.Apply({DeleteElement{"/app/group/step"}}));
  EXPECT_FALSE(Exists("/app/group/step"));
}

}  // namespace
}  // namespace runnel::test
