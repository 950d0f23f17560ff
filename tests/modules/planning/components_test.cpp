// Each component alone, on plain geometry: no robot moves here.

#include <gmock/gmock.h>

#include "modules/planning/algorithm/bug_components.h"
#include "modules/planning/algorithm/bug_variants.h"
#include "modules/planning/algorithm/tangent_graph.h"
#include "tests/modules/planning/variant_index.h"

namespace runnel {
namespace {

using testing::HasSubstr;

/// A robot at the origin that looks along x; the goal is 5 m ahead unless told otherwise.
struct Situation {
  Situation() {
    input.surroundings.is_measured = true;
    input.surroundings.sensor_range = 4.0F;
    input.surroundings.safe_distance = 0.35F;
    input.start = {-3, 0};
    input.goal = {5, 0};
    state.line_start = input.start;
    state.hit_distance = 6.0;
    state.least_distance = 5.0;
    state.least_distance_of_all = 5.0;
    state.least_distance_on_line = 6.0;
    state.status.hit_point = {-1, 0};
  }
  /// A wall at x = `distance` from y = `low` to y = `high`.
  void AddWall(double distance, double low, double high) {
    for (double y = low; y <= high; y += 0.02) AddPoint({distance, y});
  }
  void AddPoint(Point2 point) { AddBoundaryPoint(input.surroundings, {Norm(point), Direction(point)}); }
  [[nodiscard]] BugView view() const { return {configuration, state, input}; }

  BugConfiguration configuration;
  BugState state;
  BugInput input;
};

bool Leaves(LeaveKind kind, const Situation& situation) {
  return ComponentFor(kind).Find(situation.view()).has_value();
}

TEST(StraightMotion, SteersAtTheGoal) {
  Situation situation;
  EXPECT_EQ(ComponentFor(MotionKind::kStraight).Target(situation.view()).point, (Point2{5, 0}));
}

TEST(MLineMotion, SteersBackToTheLine) {
  Situation situation;
  situation.input.pose = {0, 0.3, 0};
  const Point2 target = ComponentFor(MotionKind::kMLine).Target(situation.view()).point;
  EXPECT_NEAR(target.x, 0.4, 1e-9);
  EXPECT_NEAR(target.y, 0.0, 1e-9);
}

TEST(TangentMotion, GoesStraightWhileTheWayIsFreeAsFarAsItSees) {
  Situation situation;
  situation.AddWall(2.0, 1.0, 3.0);
  const Waypoint waypoint = ComponentFor(MotionKind::kTangent).Target(situation.view());
  EXPECT_EQ(waypoint.point, (Point2{5, 0}));
  EXPECT_FALSE(waypoint.node_side);
}

TEST(TangentMotion, SteersAtTheEndOfAWallThatGivesTheShorterWay) {
  for (const double sign : {1.0, -1.0}) {
    Situation situation;
    situation.AddWall(2.0, sign > 0 ? -2.0 : -0.5, sign > 0 ? 0.5 : 2.0);
    const Waypoint waypoint = ComponentFor(MotionKind::kTangent).Target(situation.view());
    // Past the end at (2, 0.5), by the body's distance.
    EXPECT_GT(sign * waypoint.point.y, 0.6);
    EXPECT_LT(sign * waypoint.point.y, 1.2);
    EXPECT_EQ(waypoint.node_side, sign > 0 ? BoundaryDirection::kLeft : BoundaryDirection::kRight);
  }
}

TEST(TangentMotion, GoesUpToAWallOfWhichNoEndIsNearerToTheGoal) {
  Situation situation;
  situation.input.goal = {1.0, 0.0};
  situation.AddWall(0.6, -1.0, 2.0);
  const Waypoint waypoint = ComponentFor(MotionKind::kTangent).Target(situation.view());
  EXPECT_EQ(waypoint.point, (Point2{1, 0}));
  EXPECT_EQ(waypoint.node_side, BoundaryDirection::kRight) << "the end at -1 is nearer";
}

TEST(FixedDirection, IsTheOneToldWhateverIsInTheWay) {
  Situation situation;
  for (const double bearing : {-1.0, 0.0, 1.0}) {
    EXPECT_EQ(ComponentFor(DirectionKind::kLeft).Choose(situation.view(), bearing), BoundaryDirection::kLeft);
    EXPECT_EQ(ComponentFor(DirectionKind::kRight).Choose(situation.view(), bearing), BoundaryDirection::kRight);
  }
}

TEST(LocalDirection, TurnsLeast) {
  Situation situation;
  const DirectionChoice& local = ComponentFor(DirectionKind::kLocal);
  EXPECT_EQ(local.Choose(situation.view(), 0.5), BoundaryDirection::kRight);
  EXPECT_EQ(local.Choose(situation.view(), -0.5), BoundaryDirection::kLeft);
  for (const auto first : {BoundaryDirection::kLeft, BoundaryDirection::kRight}) {
    situation.configuration.first_direction = first;
    EXPECT_EQ(local.Choose(situation.view(), 0.01), first) << "head on";
  }
}

TEST(LocalDirection, TakesTheSideOfTheLastTangentNode) {
  Situation situation;
  situation.state.node_side = BoundaryDirection::kLeft;
  EXPECT_EQ(ComponentFor(DirectionKind::kLocal).Choose(situation.view(), 0.5), BoundaryDirection::kLeft);
}

TEST(AlternateDirection, IsOppositeToTheOneBefore) {
  Situation situation;
  situation.configuration.first_direction = BoundaryDirection::kRight;
  const DirectionChoice& alternate = ComponentFor(DirectionKind::kAlternate);
  EXPECT_EQ(alternate.Choose(situation.view(), 0.0), BoundaryDirection::kRight);
  situation.state.last_direction = BoundaryDirection::kRight;
  EXPECT_EQ(alternate.Choose(situation.view(), 0.0), BoundaryDirection::kLeft);
  situation.state.last_direction = BoundaryDirection::kLeft;
  EXPECT_EQ(alternate.Choose(situation.view(), 0.0), BoundaryDirection::kRight);
}

TEST(BestAfterLap, IsThePointNearestToTheGoalAndKnownAfterALapOnly) {
  Situation situation;
  situation.state.closest_point = {1, 2};
  const LeaveCondition& condition = ComponentFor(LeaveKind::kBestAfterLap);
  const auto found = condition.Find(situation.view());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->point, (Point2{1, 2}));
  EXPECT_EQ(found->approach, Approach::kAlongBoundary);
  EXPECT_FALSE(condition.ResearchComplete(situation.view()));
}

TEST(MLineCloserThanHit, NeedsACrossing) {
  Situation situation;
  EXPECT_FALSE(Leaves(LeaveKind::kMLineCloserThanHit, situation));
  situation.state.crossing = Point2{0, 0};
  EXPECT_TRUE(Leaves(LeaveKind::kMLineCloserThanHit, situation));
}

TEST(MLineCloserThanHit, IsCloserByAMargin) {
  Situation situation;
  situation.state.crossing = Point2{0, 0};
  situation.state.hit_distance = 5.05;
  EXPECT_FALSE(Leaves(LeaveKind::kMLineCloserThanHit, situation));
  situation.configuration.leave_margin = 0.0;
  EXPECT_TRUE(Leaves(LeaveKind::kMLineCloserThanHit, situation));
}

TEST(MLineCloserThanHit, IsFreeTowardsTheGoal) {
  Situation situation;
  situation.state.crossing = Point2{0, 0};
  situation.AddWall(0.37, -1, 1);
  EXPECT_FALSE(Leaves(LeaveKind::kMLineCloserThanHit, situation));
}

TEST(MLineClosestSoFar, IsNotWhereTheLineWasVisitedNearerToTheGoal) {
  Situation situation;
  situation.state.crossing = Point2{0, 0};
  EXPECT_TRUE(Leaves(LeaveKind::kMLineClosestSoFar, situation));
  situation.state.least_distance_on_line = 4.0;
  EXPECT_FALSE(Leaves(LeaveKind::kMLineClosestSoFar, situation));
  EXPECT_TRUE(Leaves(LeaveKind::kMLineCloserThanHit, situation)) << "where Bug2 differs from Alg1";
}

TEST(ClosestSoFar, ComparesWithAllPointsVisited) {
  Situation situation;
  EXPECT_TRUE(Leaves(LeaveKind::kClosestSoFar, situation));
  situation.state.least_distance_of_all = 4.5;
  EXPECT_FALSE(Leaves(LeaveKind::kClosestSoFar, situation));
  situation.state.least_distance_of_all = 5.0;
  situation.AddWall(0.37, -1, 1);
  EXPECT_FALSE(Leaves(LeaveKind::kClosestSoFar, situation));
}

TEST(CloserThanHit, ComparesWithTheHitPointAlone) {
  Situation situation;
  situation.state.least_distance_of_all = 1.0;
  EXPECT_TRUE(Leaves(LeaveKind::kCloserThanHit, situation));
  situation.state.hit_distance = 4.9;
  EXPECT_FALSE(Leaves(LeaveKind::kCloserThanHit, situation));
}

TEST(FreeToGo, ComparesWithNothing) {
  Situation situation;
  situation.state.hit_distance = 1.0;
  situation.state.least_distance_of_all = 1.0;
  EXPECT_TRUE(Leaves(LeaveKind::kFree, situation));
  situation.AddWall(0.37, -1, 1);
  EXPECT_FALSE(Leaves(LeaveKind::kFree, situation));
  EXPECT_FALSE(ComponentFor(LeaveKind::kFree).decides_after_lap());
}

TEST(FreeRangeStep, LeavesWhereItSeesThatItGetsNearerByAStep) {
  Situation situation;
  situation.configuration.step = 0.5;
  situation.state.least_distance = 4.0;
  situation.AddWall(1.5, -2, 2);  // F is about 1.15: 5 - 1.15 > 4 - 0.5
  EXPECT_FALSE(Leaves(LeaveKind::kFreeRangeStep, situation));
  situation.configuration.step = 0.1;  // 3.85 < 3.9
  EXPECT_TRUE(Leaves(LeaveKind::kFreeRangeStep, situation));
}

TEST(FreeRangeStep, LeavesWhereItSeesTheGoalHoweverFarItIs) {
  Situation situation;
  situation.input.goal = {3, 0};
  situation.state.least_distance = 0.5;
  EXPECT_TRUE(Leaves(LeaveKind::kFreeRangeStep, situation));
  situation.input.goal = {4.5, 0};
  EXPECT_FALSE(Leaves(LeaveKind::kFreeRangeStep, situation)) << "out of the sensor's range";
}

TEST(ReachBelowFollowed, LeavesWhereItSeesAPointNearerThanTheBoundary) {
  Situation situation;
  situation.state.followed_distance = 2.0;
  const auto found = ComponentFor(LeaveKind::kReachBelowFollowed).Find(situation.view());
  ASSERT_TRUE(found) << "4 m ahead, 1 m from the goal";
  EXPECT_EQ(found->approach, Approach::kAcross);
  EXPECT_NEAR(Distance(found->point, situation.input.goal), 1.9, 0.01);
  situation.state.followed_distance = 0.8;
  EXPECT_FALSE(Leaves(LeaveKind::kReachBelowFollowed, situation));
}

TEST(ReachBelowFollowed, KeepsTheNearestPointOfTheBoundaryOnItsHand) {
  Situation situation;
  situation.state.least_distance = 5.0;
  situation.state.follower.Start(BoundaryDirection::kLeft, {}, -kPi / 2);
  for (double x = -1; x <= 2.0; x += 0.02) situation.AddPoint({x, -0.37});
  const double along = ComponentFor(LeaveKind::kReachBelowFollowed).FollowedDistance(situation.view());
  EXPECT_NEAR(along, 3.0, 0.5) << "its end at x = 2";
  situation.AddPoint({3.5, 0.8});  // beyond a gap: another obstacle
  EXPECT_EQ(ComponentFor(LeaveKind::kReachBelowFollowed).FollowedDistance(situation.view()), along);
}

TEST(ReverseAtVisited, ReversesWhereItMeetsAnEarlierPoint) {
  Situation situation;
  const Revisit& reverse = ComponentFor(RevisitKind::kReverseAtVisited);
  situation.state.hits.Add({0.1, 0.0});
  situation.state.hits.Add({-1, 0});
  situation.state.last_pose = {-0.1, 0, 0};
  EXPECT_TRUE(reverse.ShallReverse(situation.view()));
  EXPECT_FALSE(ComponentFor(RevisitKind::kNone).ShallReverse(situation.view()));
  situation.state.last_pose = {0.0, 0, 0};
  EXPECT_FALSE(reverse.ShallReverse(situation.view())) << "it was there already";
}

TEST(ReverseAtVisited, DoesNotMindTheLastHitPointNorWhatIsBesideIt) {
  Situation situation;
  const Revisit& reverse = ComponentFor(RevisitKind::kReverseAtVisited);
  situation.state.status.hit_point = {0.1, 0.0};
  situation.state.leaves.Add({0.1, 0.1});
  situation.state.hits.Add({0.1, 0.0});
  situation.state.last_pose = {-0.1, 0, 0};
  EXPECT_FALSE(reverse.ShallReverse(situation.view()));
}

TEST(PointHistory, DoesNotTakeAPointRemovedForTheOldestOnceItIsFull) {
  PointHistory history;
  for (std::size_t i = 0; i < PointHistory::kCapacity + 1; ++i) {
    history.Add({static_cast<double>(i), 0.0});
  }
  history.RemoveLast();
  EXPECT_EQ(history.total(), PointHistory::kCapacity);
  ASSERT_EQ(history.size(), PointHistory::kCapacity - 1);
  EXPECT_EQ(history[0].x, 1.0);
  EXPECT_EQ(history.back().x, static_cast<double>(PointHistory::kCapacity - 1));
  history.Add({-1.0, 0.0});
  EXPECT_EQ(history.size(), PointHistory::kCapacity);
  EXPECT_EQ(history[0].x, 1.0);
  EXPECT_EQ(history.back().x, -1.0);
}

TEST(PointHistory, ForgetsTheOldestOnceItIsFull) {
  PointHistory history;
  for (std::size_t i = 0; i < PointHistory::kCapacity + 3; ++i) {
    history.Add({static_cast<double>(i), 0});
  }
  EXPECT_EQ(history.size(), PointHistory::kCapacity);
  EXPECT_EQ(history.total(), PointHistory::kCapacity + 3);
  EXPECT_EQ(history[0].x, 3.0);
  EXPECT_EQ(history.back().x, static_cast<double>(PointHistory::kCapacity + 2));
}

TEST(BugComponents, RefuseAConditionOnTheLineWithAMotionThatHasNone) {
  for (const auto leave : {LeaveKind::kMLineCloserThanHit, LeaveKind::kMLineClosestSoFar}) {
    for (const auto motion : {MotionKind::kStraight, MotionKind::kTangent}) {
      const auto misfit = FindMisfit(Assemble({motion, DirectionKind::kLeft, leave, {}}));
      ASSERT_TRUE(misfit);
      EXPECT_THAT(misfit->message, HasSubstr("needs the line from start to goal"));
      EXPECT_THAT(misfit->hint, HasSubstr("'m_line'"));
    }
    EXPECT_FALSE(FindMisfit(Assemble({MotionKind::kMLine, DirectionKind::kLeft, leave, {}})));
  }
}

TEST(BugComponents, RefuseAConditionOnRangesWithASensorThatOnlyFeels) {
  Situation situation;
  const BugComponents dist_bug = Assemble(kBugVariants[VariantIndex("dist_bug")].composition);
  EXPECT_FALSE(FindMisfit(dist_bug, situation.input.surroundings));
  situation.input.surroundings.sensor_range = 0.0F;
  const auto misfit = FindMisfit(dist_bug, situation.input.surroundings);
  ASSERT_TRUE(misfit);
  EXPECT_THAT(misfit->message, HasSubstr("'free_range_step' needs a sensor that sees"));
  const BugComponents tangent = Assemble(kBugVariants[VariantIndex("tangent_bug")].composition);
  EXPECT_FALSE(FindMisfit(tangent, situation.input.surroundings)) << "its range may be 0";
}

TEST(BugVariants, FitTogetherAndDiffer) {
  for (const BugVariant& variant : kBugVariants) {
    EXPECT_FALSE(FindMisfit(Assemble(variant.composition))) << variant.name;
    for (const BugVariant& other : kBugVariants) {
      EXPECT_EQ(variant.composition == other.composition, variant.name == other.name);
    }
  }
}

}  // namespace
}  // namespace runnel
