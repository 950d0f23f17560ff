#pragma once

#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/port/proxy_port.h"
#include "modules/behaviours/fusion.h"
#include "modules/behaviours/planner_status_teller.h"
#include "modules/behaviours/robot_behaviours.h"

namespace runnel {

/// The network of xml/apps/behaviour_demo.xml as one module type, with the ports of a planner: it can be swapped for one while
/// the robot drives, and compared with them. It reaches what it reaches; that a goal is out of reach it never says.
class Navigator final : public Group {
 public:
  using Group::Group;

  ProxyPort surroundings{{*this, "surroundings"},
                         Port::Direction::kInput,
                         TypeOf<Surroundings>(),
                         "what a sensor adaptor knows of the obstacles"};
  ProxyPort pose{{*this, "pose"}, Port::Direction::kInput, TypeOf<Pose2>(), "of the robot, world's frame"};
  ProxyPort goal{{*this, "goal"}, Port::Direction::kInput, TypeOf<Point2>(), "world's frame"};
  ProxyPort twist{{*this, "twist"}, Port::Direction::kOutput, TypeOf<Twist2>(), "how the robot shall move"};
  ProxyPort status{{*this, "status"}, Port::Direction::kOutput, TypeOf<PlannerStatus>(), "mode, distance …"};
  ProxyPort points{{*this, "points"},
                   Port::Direction::kOutput,
                   TypeOf<HitAndLeavePoints>(),
                   "where detours began and ended"};

  GroupParameter first_direction{{*this, "first_direction"},
                                 {"follow_wall/first_direction"},
                                 "which way it turns in a dead end"};
  GroupParameter cruise_speed{{*this, "cruise_speed"},
                              {"drive/speed", "avoid/speed", "follow_wall/speed"},
                              "at most"};
  GroupParameter goal_tolerance{{*this, "goal_tolerance"}, {"drive/goal_tolerance", "escape/goal_tolerance"}, "nearer than this is there"};

  DriveToGoalBehaviour drive{{*this, "drive"}};
  AvoidObstaclesBehaviour avoid{{*this, "avoid"}};
  EscapeBehaviour escape{{*this, "escape"}};
  FollowWallBehaviour follow_wall{{*this, "follow_wall"}};
  FusionBehaviour motion{{*this, "motion"}};
  EmergencyStopBehaviour emergency_stop{{*this, "emergency_stop"}};
  FusionBehaviour safe_motion{{*this, "safe_motion"}};
  PlannerStatusTeller teller{{*this, "teller"}};

 private:
  Result<void> Construct() override;
};

}  // namespace runnel
