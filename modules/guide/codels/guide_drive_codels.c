/* Codels of task drive of guide: Bug2, with its wall on the left. Lengths in m, angles in rad. */
#include "acguide.h"

#include <math.h>

#include "guide_c_types.h"

#define PI 3.14159265358979323846
#define NOTHING 65535          /* in a contour: no boundary known there */
#define CONTOUR_UNIT 0.25e-3   /* m */
#define ARRIVED 0.1            /* m, to the goal */
#define LONGEST_WALL 200.0     /* m; longer ones lead nowhere */

static double wrapped(double angle)
{
  return atan2(sin(angle), cos(angle));
}

static double bearing_of(int sector)
{
  return wrapped(2 * PI / robot_sectors * sector);
}

/* Whether something near stands in the way towards a bearing. */
static bool is_blocked(const robot_surroundings *around, double bearing, double far)
{
  for (int i = 0; i < robot_sectors; ++i) {
    double distance, offset;
    if (around->contour[i] == NOTHING) continue;
    distance = CONTOUR_UNIT * around->contour[i];
    offset = bearing_of(i) - bearing;
    if (distance * cos(offset) > 0 && distance * cos(offset) < around->safe_distance + far &&
        fabs(distance * sin(offset)) < around->safe_distance) return true;
  }
  return false;
}

static void move(const guide_twist *twist, double bearing, const guide_ids_limits_s *limits, genom_context self)
{
  robot_twist *wish = twist->data(self);
  const double turn = fmax(-limits->turn_rate, fmin(limits->turn_rate, 3 * bearing));
  wish->forward = fabs(bearing) > 0.7 ? 0 : limits->speed * cos(bearing);
  wish->turn = turn;
  twist->write(self);
}

static void stand(const guide_twist *twist, genom_context self)
{
  twist->data(self)->forward = 0;
  twist->data(self)->turn = 0;
  twist->write(self);
}

/* Null before there is one, or where it is no number. How old it is, the drive sees by what is published. */
static const robot_pose *pose_of(const guide_pose *pose, genom_context self)
{
  const robot_pose *now;
  pose->read(self);
  now = pose->data(self);
  return now && isfinite(now->x) && isfinite(now->y) && isfinite(now->heading) ? now : NULL;
}

/* Null before there is one, or where nothing was measured. */
static const robot_surroundings *view_of(const guide_surroundings *surroundings, genom_context self)
{
  const robot_surroundings *around;
  surroundings->read(self);
  around = surroundings->data(self);
  return around && around->is_measured ? around : NULL;
}

/* Fetches the pose and adds up the way; null where it is not known. */
static const robot_pose *travelled(const guide_pose *pose, guide_ids_trip_s *trip, genom_context self)
{
  const robot_pose *now = pose_of(pose, self);
  if (!now) return NULL;
  const double way = hypot(now->x - trip->last.x, now->y - trip->last.y);
  trip->length += way;
  trip->followed += way;
  trip->last.x = now->x;
  trip->last.y = now->y;
  return now;
}

genom_event
guide_begin(guide_ids *ids, const genom_context self)
{
  (void)self;
  ids->limits.speed = 0.4;
  ids->limits.turn_rate = 1.2;
  return guide_ether;
}

genom_event
guide_rest(const guide_twist *twist, const genom_context self)
{
  stand(twist, self);
  return guide_ether;
}

genom_event
guide_take(const robot_point *to, const guide_pose *pose, guide_ids_trip_s *trip, const genom_context self)
{
  const robot_pose *now = pose_of(pose, self);
  if (!now) return guide_pause_start;
  memset(trip, 0, sizeof(*trip));
  trip->is_set = true;
  trip->to = *to;
  trip->from.x = trip->last.x = now->x;
  trip->from.y = trip->last.y = now->y;
  return guide_drive;
}

genom_event
guide_resume(const guide_ids_trip_s *trip, const guide_pose *pose, const genom_context self)
{
  if (!trip->is_set) return guide_no_pose(self);
  return pose_of(pose, self) ? guide_drive : guide_pause_start;
}

/* Straight to the goal, until a wall is in the way. */
genom_event
guide_towards(const guide_pose *pose, const guide_surroundings *surroundings, const guide_ids_limits_s *limits,
              guide_ids_trip_s *trip, const guide_twist *twist, const genom_context self)
{
  const robot_pose *now = travelled(pose, trip, self);
  const robot_surroundings *around = view_of(surroundings, self);
  if (!now || !around) return guide_pause_drive;
  const double x = trip->to.x - now->x, y = trip->to.y - now->y;
  const double bearing = wrapped(atan2(y, x) - now->heading);
  if (hypot(x, y) < ARRIVED) return guide_arrived;
  if (is_blocked(around, bearing, 0.15)) {
    trip->hit_distance = hypot(x, y);
    trip->followed = 0;
    return guide_follow;
  }
  move(twist, bearing, limits, self);
  return guide_pause_drive;
}

/* Along the wall, until the line from start to goal is met again, nearer to the goal. */
genom_event
guide_along(const guide_pose *pose, const guide_surroundings *surroundings, const guide_ids_limits_s *limits,
            guide_ids_trip_s *trip, const guide_twist *twist, const genom_context self)
{
  const robot_pose *now = travelled(pose, trip, self);
  const robot_surroundings *around = view_of(surroundings, self);
  if (!now || !around) return guide_pause_follow;
  const double x = trip->to.x - now->x, y = trip->to.y - now->y;
  const double line_x = trip->to.x - trip->from.x, line_y = trip->to.y - trip->from.y;
  const double off_line = fabs(line_x * y - line_y * x) / fmax(hypot(line_x, line_y), 1e-6);
  const double bearing = wrapped(atan2(y, x) - now->heading);
  if (hypot(x, y) < ARRIVED) return guide_arrived;
  if (off_line < 0.05 && hypot(x, y) < trip->hit_distance - 0.1 && !is_blocked(around, bearing, 0.2)) return guide_drive;
  if (trip->followed > LONGEST_WALL) {
    const guide_no_way_detail so_far = {trip->length};
    stand(twist, self);
    return guide_no_way(&so_far, self);
  }
  double nearest = 1e9, wall = 0;
  for (int i = 0; i < robot_sectors; ++i) {
    if (around->contour[i] == NOTHING || CONTOUR_UNIT * around->contour[i] >= nearest) continue;
    nearest = CONTOUR_UNIT * around->contour[i];
    wall = bearing_of(i);
  }
  /* Square to the nearest point, a little towards it or away from it. */
  const double apart = around->safe_distance + 0.05;
  const double inwards = fmax(-0.8, fmin(0.8, 4 * (nearest - apart)));
  move(twist, wrapped(wall - PI / 2 + inwards), limits, self);
  return guide_pause_follow;
}

genom_event
guide_arrive(double way, double *length, const guide_twist *twist, const genom_context self)
{
  *length = way;
  stand(twist, self);
  return guide_ether;
}
