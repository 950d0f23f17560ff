#include "modules/simulation/algorithm/camera_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace runnel {

namespace {

struct Colour {
  double red, green, blue;
};

constexpr Colour kSky{226, 233, 241};
constexpr Colour kWall{112, 124, 142};
constexpr Colour kLightGround{202, 205, 205};
constexpr Colour kDarkGround{186, 190, 192};

Colour Mixed(const Colour& from, const Colour& to, double share) {
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

// One column of pixels after the other, from the left; each is one ray.
class Painter {
 public:
  Painter(const Pose2& pose, const CameraOptions& options, Image& image)
      : pose_(pose), options_(options), image_(image) {
    focal_ = options.width / 2.0 / std::tan(options.field_of_view / 2);
    horizon_ = options.height / 2.0;
  }

  [[nodiscard]] double BearingOf(std::uint32_t column) const {
    return std::atan2(options_.width / 2.0 - (column + 0.5), focal_);
  }

  // `distance`: along the ray; `before`: that of the ray beside it, by which a surface is lit.
  void Paint(std::uint32_t column, double distance, double before) {
    const double bearing = BearingOf(column);
    const double depth = distance * std::cos(bearing);
    const double top = horizon_ - focal_ * (options_.obstacle_height - options_.eye_height) / depth;
    const double bottom = horizon_ + focal_ * options_.eye_height / depth;
    const double haze = std::min(1.0, distance / options_.range);
    const double slope = std::isfinite(before) ? (distance - before) / distance * 12 : 0;
    const Colour lit = Mixed(kWall, {255, 255, 255}, std::clamp(0.12 + slope, 0.0, 0.35));
    const Colour wall = Mixed(lit, kSky, haze);
    for (std::uint32_t row = 0; row < options_.height; ++row) {
      const double at = row + 0.5;
      if (at >= std::max(bottom, horizon_ + 1)) {
        Set(column, row, Ground(bearing, at));
      } else {
        Set(column, row, std::isfinite(distance) && at >= top && at < bottom ? wall : kSky);
      }
    }
  }

 private:
  [[nodiscard]] Colour Ground(double bearing, double at) const {
    const double depth = focal_ * options_.eye_height / (at - horizon_);
    const double distance = depth / std::cos(bearing);
    const double x = pose_.x + distance * std::cos(pose_.heading + bearing);
    const double y = pose_.y + distance * std::sin(pose_.heading + bearing);
    const bool is_dark = std::fmod(std::abs(std::floor(x) + std::floor(y)), 2.0) > 0.5;
    return Mixed(is_dark ? kDarkGround : kLightGround, kSky, std::min(1.0, distance / options_.range));
  }

  void Set(std::uint32_t column, std::uint32_t row, const Colour& colour) {
    std::uint8_t* const pixel = &image_.data[std::size_t{row} * image_.row_stride + 3 * column];
    pixel[0] = static_cast<std::uint8_t>(colour.red);
    pixel[1] = static_cast<std::uint8_t>(colour.green);
    pixel[2] = static_cast<std::uint8_t>(colour.blue);
  }

  const Pose2& pose_;
  const CameraOptions& options_;
  Image& image_;
  double focal_ = 1;  // pixels
  double horizon_ = 0;
};

}  // namespace

void TakePicture(const RayCaster& rays, const Pose2& pose, const CameraOptions& options, Image& image) {
  image.width = options.width;
  image.height = options.height;
  image.encoding = "rgb8";
  image.row_stride = 3 * options.width;
  image.data.resize(std::size_t{image.row_stride} * image.height);
  Painter painter(pose, options, image);
  double before = std::numeric_limits<double>::infinity();
  for (std::uint32_t column = 0; column < options.width; ++column) {
    const double direction = pose.heading + painter.BearingOf(column);
    const double distance = std::max(1e-3, rays.Cast(Position(pose), direction, options.range));
    painter.Paint(column, distance, before);
    before = distance;
  }
}

}  // namespace runnel
