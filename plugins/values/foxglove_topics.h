#pragma once

#include <span>
#include <string>

#include "core/element/framework_element.h"
#include "core/port/port.h"

namespace runnel {

/// The name of an element for people who see only one application: its path without the application
/// and without groups of ports: "/bug_demo/robot/planner/output/twist" is "/robot/planner/twist". Two ports
/// of a module may come to the same name, an input and an output for example. Under the structure lock.
[[nodiscard]] std::string TopicOf(const FrameworkElement& element);

/// The output whose poses tell where the robot is, for the transform: of all that publish poses, the
/// one that the most inputs read; of equals the first. nullptr if there is none. Under the structure
/// lock.
[[nodiscard]] const Port* RobotPose(std::span<const Port* const> ports);

}  // namespace runnel
