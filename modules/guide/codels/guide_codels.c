/* Codels of the control task of guide: what a request may ask for. */
#include "acguide.h"

#include <math.h>

#include "guide_c_types.h"

genom_event
guide_check_limits(const guide_ids_limits_s *limits, const genom_context self)
{
  const guide_too_far_detail most = {1.0};
  if (limits->speed > 0 && limits->speed <= most.limit && limits->turn_rate > 0) return genom_ok;
  return guide_too_far(&most, self);
}

genom_event
guide_check_goal(const robot_point *to, const genom_context self)
{
  const guide_too_far_detail most = {100.0};
  if (fabs(to->x) <= most.limit && fabs(to->y) <= most.limit) return genom_ok;
  return guide_too_far(&most, self);
}
