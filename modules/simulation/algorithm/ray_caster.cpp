#include "modules/simulation/algorithm/ray_caster.h"

#include "modules/simulation/algorithm/internal/ray_grid.h"

namespace runnel {

RayCaster::RayCaster(const Outline& outline, double eye_height)
    : grid_(std::make_unique<const internal::RayGrid>(outline, eye_height)) {}
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;
RayCaster::~RayCaster() = default;

double RayCaster::Cast(Point2 origin, double direction, double range) const {
  return grid_->Cast(origin, UnitVector(direction), range);
}

void RayCaster::CastFan(Point2 origin, double first_direction, double direction_step, double range,
                        std::span<float> distances) const {
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double direction = first_direction + static_cast<double>(i) * direction_step;
    distances[i] = static_cast<float>(Cast(origin, direction, range));
  }
}

}  // namespace runnel
