#include <algorithm>
#include <array>

#include "modules/planning/algorithm/bug_components.h"
#include "modules/planning/algorithm/tangent_graph.h"

namespace runnel {

namespace {

constexpr double kPassNoise = 0.02;  // m by which two passes of the same point differ in d

std::optional<LeavePoint> HereIf(bool condition, const BugView& view) {
  if (!condition) return std::nullopt;
  return LeavePoint{Position(view.input.pose), Approach::kNear};
}

bool IsCloserThanHit(const BugView& view, double distance) {
  return distance < view.state.hit_distance - view.configuration.leave_margin;
}

// Where the robot crosses the M-line, if that is closer than the hit point and free.
std::optional<LeavePoint> GoodCrossing(const BugView& view) {
  const auto& crossing = view.state.crossing;
  if (!crossing || !IsCloserThanHit(view, Distance(*crossing, view.input.goal)) || !IsFreeTowardsGoal(view)) {
    return std::nullopt;
  }
  return LeavePoint{*crossing, Approach::kNear};
}

// Of the straight way to `end` the first point with d < `wanted`. Precondition: d(end) < `wanted`.
Point2 FirstPointWithin(const BugView& view, Point2 end, double wanted) {
  constexpr int kHalvings = 16;
  Point2 outside = Position(view.input.pose), inside = end;
  for (int i = 0; i < kHalvings; ++i) {
    const Point2 middle = 0.5 * (outside + inside);
    (Distance(middle, view.input.goal) < wanted ? inside : outside) = middle;
  }
  return inside;
}

class BestAfterLap final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "best_after_lap"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override {
    return LeavePoint{view.state.closest_point, Approach::kAlongBoundary};
  }
  [[nodiscard]] bool ResearchComplete(const BugView& view) const override { return view.state.lap.is_complete(); }
};

class OnMLine final : public LeaveCondition {
 public:
  constexpr OnMLine(std::string_view name, bool is_closest_so_far)
      : name_(name), is_closest_so_far_(is_closest_so_far) {}
  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] bool needs_m_line() const override { return true; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override {
    const auto point = GoodCrossing(view);
    const double closest = view.state.least_distance_on_line + kPassNoise;
    const bool is_known_closer = is_closest_so_far_ && point && Distance(point->point, view.input.goal) > closest;
    return is_known_closer ? std::nullopt : point;
  }

 private:
  std::string_view name_;
  bool is_closest_so_far_;
};

// Where the robot is, if it is close enough there, and free.
class WhereItIs final : public LeaveCondition {
 public:
  using Rule = bool (*)(const BugView& view);
  constexpr WhereItIs(std::string_view name, Rule is_close_enough, bool decides_after_lap)
      : name_(name), is_close_enough_(is_close_enough), decides_after_lap_(decides_after_lap) {}
  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] bool decides_after_lap() const override { return decides_after_lap_; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override {
    return HereIf(is_close_enough_(view) && IsFreeTowardsGoal(view), view);
  }

 private:
  std::string_view name_;
  Rule is_close_enough_;
  bool decides_after_lap_;
};

bool IsHereCloserThanHit(const BugView& view) { return IsCloserThanHit(view, DistanceToGoal(view)); }

bool IsHereClosestSoFar(const BugView& view) {
  return IsHereCloserThanHit(view) && DistanceToGoal(view) <= view.state.least_distance_of_all + kPassNoise;
}

class FreeRangeStep final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "free_range_step"; }
  [[nodiscard]] bool needs_range_sensor() const override { return true; }
  [[nodiscard]] bool MayMissPassages(const BugView&) const override { return true; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override {
    return HereIf(MayLeave(view), view);
  }
  [[nodiscard]] bool MayLeave(const BugView& view) const override {
    const double rest = DistanceToGoal(view) - FreeRangeTowardsGoal(view);
    return rest <= 0.0 || rest <= view.state.least_distance - view.configuration.step;
  }
};

class ReachBelowFollowed final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "reach_below_followed"; }
  [[nodiscard]] bool MayMissPassages(const BugView& view) const override { return view.input.surroundings.is_vague; }
  [[nodiscard]] double FollowedDistance(const BugView& view) const override {
    const double contact = view.state.follower.Contact(view.input.surroundings).bearing;
    return std::min({view.state.followed_distance, view.state.least_distance,
                     GraphOf(view).SectionDistance(view.input.goal, contact)});
  }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override {
    const double wanted = view.state.followed_distance - view.configuration.leave_margin;
    const Point2 nearest = GraphOf(view).NearestReachable(view.input.goal);
    if (Distance(nearest, view.input.goal) >= wanted) return std::nullopt;
    return LeavePoint{FirstPointWithin(view, nearest, wanted), Approach::kAcross};
  }

 private:
  static TangentGraph GraphOf(const BugView& view) {
    return {view.input.surroundings, view.input.pose, PassingRadius(view), ViewRange(view)};
  }
};

}  // namespace

std::span<const LeaveCondition* const> AllLeaveConditions() {
  static const BestAfterLap best_after_lap;
  static const OnMLine m_line_closer_than_hit("m_line_closer_than_hit", false);
  static const OnMLine m_line_closest_so_far("m_line_closest_so_far", true);
  static const WhereItIs closest_so_far("closest_so_far", IsHereClosestSoFar, true);
  static const FreeRangeStep free_range_step;
  static const ReachBelowFollowed reach_below_followed;
  static const WhereItIs closer_than_hit("closer_than_hit", IsHereCloserThanHit, true);
  static const WhereItIs free(
      "free", [](const BugView&) { return true; }, false);
  static constexpr std::array<const LeaveCondition*, 8> all{
      &best_after_lap,  &m_line_closer_than_hit, &m_line_closest_so_far, &closest_so_far,
      &free_range_step, &reach_below_followed,   &closer_than_hit,       &free};
  return all;
}

}  // namespace runnel
