#pragma once

#include <string>

namespace runnel::test {

/// The file of a robot that is a node of ROS 2 by that engine: `run FILE world=WORLD`.
inline std::string RosRobot(const std::string& engine) {
  return R"(<application name="robot" thread="control">
  <load plugin="simulation"/> <load plugin="motion"/>
  <clock type="simulated" speed="1"/> <thread name="control" period="50ms"/>
  <network name="base" engine=")" +
         engine + R"(">
    <offer port="laser/scan" topic="/scan" as="sensor_msgs/msg/LaserScan" frame="laser" qos="sensor"/>
    <offer port="world/pose" topic="/tf" as="tf2_msgs/msg/TFMessage" frame="map" child_frame="base_link"/>
    <offer port="world/pose" topic="/tf_static" as="tf2_msgs/msg/TFMessage" frame="map" child_frame="start" qos="latched"/>
    <take topic="/cmd_vel" as="geometry_msgs/msg/Twist" to="gate/wanted" live="true"/>
    <ros distribution="jazzy" node="/robots/base" clock="true" log="true"/>
  </network>
  <module name="world" type="simulation/world"> <parameter name="world" command_line="world"/> </module>
  <module name="laser" type="simulation/laser"/>
  <module name="gate" type="motion/command_gate"/>
  <module name="drive" type="motion/differential_drive"/>
  <connect from="world/scene" to="laser/scene"/> <connect from="world/pose" to="laser/pose"/>
  <connect from="gate/allowed" to="drive/twist"/> <connect from="drive/wheels" to="world/wheels"/>
</application>)";
}

}  // namespace runnel::test
