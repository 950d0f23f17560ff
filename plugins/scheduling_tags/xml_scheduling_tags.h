#pragma once

#include <vector>

#include "core/base/error.h"
#include "core/element/annotation.h"
#include "plugins/runtime_construction/xml_tag.h"
#include "plugins/scheduling/fault.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

/// Adds what application files say of how they are run:
///
///     <clock type="simulated" speed="1" paused="false"/>
///     <thread name="control" period="50ms" priority="0" on_overrun="skip"/>
///     <on_fault of="laser" action="stop_application"/>
///     <on_fault of="laser" set="motion/stop" value="true"/>
///
/// and the attribute thread="control" of <application>, <group> and <module>. Threads are made
/// below the application, as <application>/threads/<name>, so that they come and go with it.
void AddSchedulingTags(XmlTagRegistry& tags);

/// What the application file says of the clock; without <clock>, the defaults of SchedulerOptions.
[[nodiscard]] SchedulerOptions SchedulerOptionsOf(const FrameworkElement& application);

/// What the application file says of faults, with where it says so, in the order of the file. The
/// rules have been checked; paths in them are absolute.
struct PlacedFaultRule {
  FaultRule rule;
  SourcePosition position;
};
[[nodiscard]] std::vector<PlacedFaultRule> FaultRulesOf(const FrameworkElement& application);

namespace internal {

[[nodiscard]] XmlTag ClockTag();
[[nodiscard]] XmlTag ThreadTag();
[[nodiscard]] AddedAttribute ThreadAttribute(std::string tag);
[[nodiscard]] XmlTag OnFaultTag();

/// The application that `element` is part of: what is directly below the root.
[[nodiscard]] FrameworkElement& ApplicationOf(FrameworkElement& element);

}  // namespace internal

}  // namespace runnel
