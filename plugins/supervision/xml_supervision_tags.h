#pragma once

#include "plugins/runtime_construction/xml_tag.h"
#include "plugins/supervision/supervisor.h"

namespace runnel {

/// Adds what application files say of sensors that fall silent, and of more than one thing that is to
/// be done about a fault:
///
///     <on_stale input="robot/eyes/scan" after="300ms" fresh_after="1s">
///       <switch input="robot/planner/surroundings" from="laser_eyes/surroundings"
///               to="infrared_eyes/surroundings"/>
///       <set parameter="robot/gate/speed" value="0.2"/>
///       <otherwise>
///         <switch …/>
///       </otherwise>
///     </on_stale>
///     <on_fault of="laser"> <replace module="laser" by="simulation/laser"/> <stop/> </on_fault>
void AddSupervisionTags(XmlTagRegistry& tags);

/// Adds the rules that the application file has to `supervisor`. The error has the place.
Result<void> AddSupervisionRules(const FrameworkElement& application, Supervisor& supervisor);

}  // namespace runnel
