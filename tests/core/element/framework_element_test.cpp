#include "core/element/framework_element.h"

#include <gmock/gmock.h>

#include "core/element/runtime.h"

namespace runnel {
namespace {

using testing::HasSubstr;

class PlainNode final : public FrameworkElement {
 public:
  explicit PlainNode(const Placement& placement) : FrameworkElement(placement) {}
};

class FrameworkElementTest : public testing::Test {
 protected:
  Runtime runtime;
  PlainNode& robot = runtime.Create<PlainNode>(runtime.root(), "robot");
  PlainNode& guard = runtime.Create<PlainNode>(robot, "guard");
};

TEST_F(FrameworkElementTest, PathNamesAllParents) {
  EXPECT_EQ(guard.path(), "/robot/guard");
  EXPECT_EQ(runtime.root().path(), "/");
}

TEST_F(FrameworkElementTest, FindFollowsRelativeAndAbsolutePaths) {
  EXPECT_EQ(*runtime.root().Find("robot/guard"), &guard);
  EXPECT_EQ(*guard.Find("/robot"), &robot);
  EXPECT_EQ(*guard.Find("../guard"), &guard);
  EXPECT_EQ(*guard.Find("."), &guard);
}

TEST_F(FrameworkElementTest, FindNamesThePartThatIsMissingAndTheNearestName) {
  const auto found = runtime.root().Find("robot/gaurd/scan");
  ASSERT_FALSE(found);
  EXPECT_THAT(found.error().message, HasSubstr("no 'gaurd' in /robot"));
  EXPECT_EQ(found.error().hint, "did you mean 'guard'?");
}

TEST_F(FrameworkElementTest, FindAboveTheRootIsAnError) { EXPECT_FALSE(runtime.root().Find("..")); }

TEST_F(FrameworkElementTest, DuplicateAndBadNamesAreRefusedAndLeaveNothingBehind) {
  EXPECT_THROW(runtime.Create<PlainNode>(robot, "guard"), ElementError);
  EXPECT_THROW(runtime.Create<PlainNode>(robot, "a/b"), ElementError);
  EXPECT_EQ(robot.children().size(), 1u);
}

TEST_F(FrameworkElementTest, VisitComesToParentsBeforeChildrenInOrderOfCreation) {
  runtime.Create<PlainNode>(robot, "planner");
  std::string names;
  runtime.root().Visit([&](FrameworkElement& element) { names += element.name() + " "; });
  EXPECT_EQ(names, " robot guard planner ");
}

TEST_F(FrameworkElementTest, IsAtOrBelowTellsTheTreeNotTheName) {
  EXPECT_TRUE(guard.IsAtOrBelow(robot));
  EXPECT_TRUE(guard.IsAtOrBelow(guard));
  EXPECT_FALSE(robot.IsAtOrBelow(guard));
}

struct Colour : Annotation {
  explicit Colour(int v) : value(v) {}
  int value;
};
struct Weight : Annotation {};

TEST_F(FrameworkElementTest, AnnotationsAreKeptByTheirType) {
  EXPECT_EQ(guard.FindAnnotation<Colour>(), nullptr);
  guard.Annotate(std::make_unique<Colour>(1));
  guard.Annotate(std::make_unique<Weight>());
  guard.Annotate(std::make_unique<Colour>(2));
  EXPECT_EQ(guard.FindAnnotation<Colour>()->value, 2);
  EXPECT_NE(guard.FindAnnotation<Weight>(), nullptr);
  EXPECT_EQ(robot.FindAnnotation<Colour>(), nullptr);
}

}  // namespace
}  // namespace runnel
