#pragma once

namespace runnel {

class PluginRegistry;

/// What networks of behaviours add to application files and to `runnel check`, for plugins that have behaviours:
///
///     <group name="motion" characteristic="fusion">   one within speaks for the group
///     <never active="drive stop"/>                    never both
///     <eventually active="drive" after="escape"/>     each time after
void AddBehaviourWords(PluginRegistry& registry);

}  // namespace runnel
