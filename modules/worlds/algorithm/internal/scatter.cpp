#include <algorithm>
#include <optional>
#include <vector>

#include "modules/worlds/algorithm/internal/generated_worlds.h"

namespace runnel::internal {

namespace {

constexpr double kShapePerArea = 0.07;  // 1/m²
constexpr int kTriesPerShape = 60;      // in a ring, of all shapes together
constexpr double kLeastRadius = 0.35;   // m
constexpr double kRingShape = 0.7;      // m, the greatest radius in a ring

struct Disc {
  Point2 centre;
  double radius;
};

class Scatter {
 public:
  Scatter(const GeneratorOptions& options, Random& random)
      : options_(options), random_(random), gap_(options.gap + kRoundingMargin) {}

  World Make() {
    const double x = options_.width / 2, y = options_.height / 2;
    world_.bounds = Ring{Rounded({-x, -y}), Rounded({x, -y}), Rounded({x, y}), Rounded({-x, y})};
    const double inset = options_.gap;
    const Point2 start = Rounded({-x + inset, random_.Between(-y + inset, y - inset)});
    world_.start = {start.x, start.y, 0.0};
    // The enclosure must not touch the bounds.
    const double goal_inset = 2.0 * options_.gap;
    world_.goal = Rounded({x - goal_inset, random_.Between(-y + goal_inset, y - goal_inset)});
    taken_ = {{start, 0.0}, {world_.goal, options_.is_enclosed ? options_.gap : 0.0}};
    limits_ = Point2{x, y};
    int left = options_.count > 0 ? options_.count : static_cast<int>(kShapePerArea * options_.width * options_.height);
    const double greatest = std::min({1.6, options_.width / 8, options_.height / 8});
    for (int tries = left * kTriesPerShape; left > 0 && tries > 0; --tries) {
      const double along = random_.Between(-0.5, 0.5) * options_.width,
                   up = random_.Between(-0.5, 0.5) * options_.height;
      if (Place({{along, up}, random_.Between(kLeastRadius, greatest)})) --left;
    }
    return world_;
  }

  /// Each ring has as many shapes as find room; those of one may be in the way of another's.
  World MakeRings() {
    const Point2 start = Rounded({-options_.width / 4, 0.0});
    world_.start = {start.x, start.y, 0.0};
    world_.goal = {-start.x, 0.0};
    taken_ = {{start, 0.0}, {world_.goal, options_.is_enclosed ? options_.gap : 0.0}};
    const int rings = options_.count > 0 ? options_.count : 1 + random_.Below(2);
    for (int ring = 0; ring < rings; ++ring) {
      const double radius = 2.0 * gap_ + kRingShape + ring * (gap_ + 2.0 * kRingShape);
      for (const Point2 middle : {start, world_.goal}) {
        for (int tries = 0; tries < kTriesPerShape; ++tries) {
          const Point2 centre = middle + radius * UnitVector(random_.Between(-kPi, kPi));
          Place({centre, random_.Between(kLeastRadius, kRingShape)});
        }
      }
    }
    return world_;
  }

 private:
  /// Whether there was room.
  bool Place(const Disc& disc) {
    const int shape = random_.Below(4);  // drawn in any case, so that tries are alike
    if (!Fits(disc)) return false;
    taken_.push_back(disc);
    Add(disc, shape);
    return true;
  }

  bool Fits(const Disc& disc) const {
    const double room = disc.radius + gap_;
    if (limits_ && std::abs(disc.centre.x) + room > limits_->x) return false;
    if (limits_ && std::abs(disc.centre.y) + room > limits_->y) return false;
    return std::ranges::all_of(
        taken_, [&](const Disc& other) { return Distance(other.centre, disc.centre) >= room + other.radius; });
  }

  void Add(const Disc& disc, int shape) {
    switch (shape) {
      case 0:
        world_.cylinders.push_back({.centre = Rounded(disc.centre), .radius = Rounded(disc.radius - kRoundingMargin)});
        break;
      case 1:
        AddBox(disc);
        break;
      case 2:
        AddPolygon(disc);
        break;
      default:
        AddHook(disc);
    }
  }

  void AddBox(const Disc& disc) {
    const double half_angle = random_.Between(0.3, kPi / 2 - 0.3);
    const double diameter = 2.0 * (disc.radius - kRoundingMargin);
    const Point2 centre = Rounded(disc.centre);
    world_.boxes.push_back({.pose = {centre.x, centre.y, Rounded(random_.Between(0.0, kPi))},
                            .length = Rounded(diameter * std::cos(half_angle)),
                            .width = Rounded(diameter * std::sin(half_angle))});
  }

  /// Three to seven corners on the circle, far enough from each other.
  void AddPolygon(const Disc& disc) {
    const int corners = 3 + random_.Below(5);
    const double turn = 2.0 * kPi / corners, first = random_.Between(0.0, kPi);
    PolygonObstacle polygon;
    for (int i = 0; i < corners; ++i) {
      const double direction = first + turn * (i + random_.Between(-0.3, 0.3));
      polygon.outline.push_back(Rounded(disc.centre + (disc.radius - kRoundingMargin) * UnitVector(direction)));
    }
    world_.polygons.push_back(std::move(polygon));
  }

  /// An L: not convex, and its inner corner has room for what fits through a gap.
  void AddHook(const Disc& disc) {
    const double reach = (disc.radius - kRoundingMargin) / std::sqrt(2.0);
    const double arm = reach * random_.Between(0.5, 0.9);
    const Pose2 frame{disc.centre.x, disc.centre.y, random_.Below(4) * kPi / 2};
    PolygonObstacle hook;
    for (const Point2 corner :
         {Point2{-reach, -reach}, Point2{reach, -reach}, Point2{reach, -reach + arm},
          Point2{-reach + arm, -reach + arm}, Point2{-reach + arm, reach}, Point2{-reach, reach}}) {
      hook.outline.push_back(Rounded(ToWorld(frame, corner)));
    }
    world_.polygons.push_back(std::move(hook));
  }

  const GeneratorOptions& options_;
  Random& random_;
  const double gap_;  // m
  World world_;
  std::vector<Disc> taken_;
  std::optional<Point2> limits_;  // m, of the ground to either side
};

}  // namespace

World MakeScatter(const GeneratorOptions& options, Random& random) { return Scatter(options, random).Make(); }

World MakeRing(const GeneratorOptions& options, Random& random) { return Scatter(options, random).MakeRings(); }

}  // namespace runnel::internal
