#include <initializer_list>
#include <utility>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/proxy_port.h"
#include "modules/behaviours/conditional_stimulator.h"
#include "modules/behaviours/fusion.h"
#include "modules/behaviours/number_to_activity.h"
#include "modules/behaviours/planner_status_teller.h"
#include "modules/behaviours/robot_behaviours.h"
#include "plugins/behaviours/xml_behaviour_words.h"

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
  ProxyPort points{
      {*this, "points"}, Port::Direction::kOutput, TypeOf<HitAndLeavePoints>(), "where detours began and ended"};

  GroupParameter first_direction{
      {*this, "first_direction"}, {"follow_wall/first_direction"}, "which way it turns in a dead end"};
  GroupParameter cruise_speed{{*this, "cruise_speed"}, {"drive/speed", "avoid/speed", "follow_wall/speed"}, "at most"};
  GroupParameter goal_tolerance{
      {*this, "goal_tolerance"}, {"drive/goal_tolerance", "escape/goal_tolerance"}, "nearer than this is there"};

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

namespace {

Result<void> ConnectAll(std::initializer_list<std::pair<Port*, Port*>> connections) {
  for (const auto& [from, to] : connections) {
    if (auto connected = Port::Connect(*from, *to); !connected) return connected;
  }
  return {};
}

}  // namespace

Result<void> Navigator::Construct() {
  for (Behaviour* const each :
       std::initializer_list<Behaviour*>{&drive, &escape, &motion, &emergency_stop, &safe_motion}) {
    if (auto set = each->stimulation_mode.Set(StimulationMode::kEnabled); !set) return set;
  }
  for (FusionBehaviour* const each : {&motion, &safe_motion}) {
    if (auto set = each->type.Set(TypeOf<Twist2>().name()); !set) return set;
  }
  if (auto set = motion.channels.Set(3); !set) return set;
  if (auto set = safe_motion.method.Set(FusionMethod::kWinnerTakesAll); !set) return set;
  for (Behaviour* const each : std::initializer_list<Behaviour*>{&drive, &avoid, &escape, &follow_wall, &motion,
                                                                 &emergency_stop, &safe_motion}) {
    if (auto constructed = Runtime::Construct(*each); !constructed) return constructed;
  }
  for (auto attached : {motion.Attach(1, drive, drive.twist.port), motion.Attach(2, avoid, avoid.twist.port),
                        motion.Attach(3, follow_wall, follow_wall.twist.port),
                        safe_motion.Attach(1, emergency_stop, emergency_stop.twist.port),
                        safe_motion.Attach(2, motion, motion.out())}) {
    if (!attached) return attached;
  }
  return ConnectAll({{&drive.activity, &avoid.stimulation},
                     {&escape.activity, &drive.inhibition(0)},
                     {&escape.activity, &follow_wall.stimulation},
                     {&motion.out(), &emergency_stop.wanted},
                     {&drive.target_rating, &teller.content},
                     {&follow_wall.activity, &teller.detour},
                     {&pose, &drive.pose},
                     {&pose, &escape.pose},
                     {&pose, &emergency_stop.pose},
                     {&pose, &teller.pose},
                     {&goal, &drive.goal},
                     {&goal, &escape.goal},
                     {&goal, &teller.goal},
                     {&surroundings, &avoid.surroundings},
                     {&surroundings, &escape.surroundings},
                     {&surroundings, &follow_wall.surroundings},
                     {&surroundings, &emergency_stop.surroundings},
                     {&safe_motion.out(), &twist},
                     {&teller.status, &status},
                     {&teller.points, &points}});
}

}  // namespace runnel

RUNNEL_PLUGIN(behaviours, registry) {
  using namespace runnel;
  RegisterMetaSignals();
  AddBehaviourWords(registry);
  registry.Add<FusionBehaviour>("behaviours/fusion", "makes what several behaviours want one");
  registry.Add<ConditionalStimulator>("behaviours/conditional_stimulator",
                                      "stimulates when conditions are met, for sequences");
  registry.Add<NumberToActivity>("behaviours/number_to_activity", "makes an activity of a number, by a curve");
  registry.Add<DriveToGoalBehaviour>("behaviours/drive_to_goal", "drives straight to a goal");
  registry.Add<AvoidObstaclesBehaviour>("behaviours/avoid_obstacles", "turns away from obstacles");
  registry.Add<FollowWallBehaviour>("behaviours/follow_wall", "drives along a wall");
  registry.Add<EscapeBehaviour>("behaviours/escape", "notices dead ends");
  registry.Add<EmergencyStopBehaviour>("behaviours/emergency_stop", "stops where the way ahead ends");
  registry.Add<Navigator>("behaviours/navigator",
                          "the network of these that drives to a goal, in the place of a planner");
  registry.Add<PlannerStatusTeller>("behaviours/planner_status", "says how a network gets on, as planners do");
}
