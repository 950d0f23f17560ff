#include "core/plugin/plugin_entry.h"
#include "modules/behaviours/conditional_stimulator.h"
#include "modules/behaviours/fusion.h"
#include "modules/behaviours/navigator.h"
#include "modules/behaviours/number_to_activity.h"
#include "modules/behaviours/planner_status_teller.h"
#include "modules/behaviours/robot_behaviours.h"
#include "plugins/behaviours/xml_behaviour_words.h"

RUNNEL_PLUGIN(behaviours, registry) {
  using namespace runnel;
  RegisterMetaSignals();
  AddBehaviourWords(registry);
  registry.Add<FusionBehaviour>("behaviours/fusion", "makes what several behaviours want one");
  registry.Add<ConditionalStimulator>("behaviours/conditional_stimulator", "stimulates when conditions are met, for sequences");
  registry.Add<NumberToActivity>("behaviours/number_to_activity", "makes an activity of a number, by a curve");
  registry.Add<DriveToGoalBehaviour>("behaviours/drive_to_goal", "drives straight to a goal");
  registry.Add<AvoidObstaclesBehaviour>("behaviours/avoid_obstacles", "turns away from obstacles");
  registry.Add<FollowWallBehaviour>("behaviours/follow_wall", "drives along a wall");
  registry.Add<EscapeBehaviour>("behaviours/escape", "notices dead ends");
  registry.Add<EmergencyStopBehaviour>("behaviours/emergency_stop", "stops where the way ahead ends");
  registry.Add<Navigator>("behaviours/navigator", "the network of these that drives to a goal, in the place of a planner");
  registry.Add<PlannerStatusTeller>("behaviours/planner_status", "says how a network gets on, as planners do");
}
