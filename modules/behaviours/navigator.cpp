#include "modules/behaviours/navigator.h"

#include <initializer_list>
#include <utility>

#include "core/element/runtime.h"

namespace runnel {

namespace {

Result<void> ConnectAll(std::initializer_list<std::pair<Port*, Port*>> connections) {
  for (const auto& [from, to] : connections) {
    if (auto connected = Port::Connect(*from, *to); !connected) return connected;
  }
  return {};
}

}  // namespace

Result<void> Navigator::Construct() {
  for (Behaviour* const each : std::initializer_list<Behaviour*>{&drive, &escape, &motion, &emergency_stop, &safe_motion}) {
    if (auto set = each->stimulation_mode.Set(StimulationMode::kEnabled); !set) return set;
  }
  for (FusionBehaviour* const each : {&motion, &safe_motion}) {
    if (auto set = each->type.Set(TypeOf<Twist2>().name()); !set) return set;
  }
  if (auto set = motion.channels.Set(3); !set) return set;
  if (auto set = safe_motion.method.Set(FusionMethod::kWinnerTakesAll); !set) return set;
  for (Behaviour* const each :
       std::initializer_list<Behaviour*>{&drive, &avoid, &escape, &follow_wall, &motion, &emergency_stop, &safe_motion}) {
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
