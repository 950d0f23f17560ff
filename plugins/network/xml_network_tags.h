#pragma once

#include "plugins/application_files/xml_tag.h"

namespace runnel {

/// Adds what application files say of the network:
///
///     <network domain="0" name="base" reach="loopback">
///       <offer ports="laser/scan localisation/pose !**/debug"/>
///       <offer port="laser/scan" topic="/scan" as="sensor_msgs/msg/LaserScan" qos="sensor" rate="20"/>
///       <take topic="/cmd_vel" as="geometry_msgs/msg/Twist" to="drive/twist"/>
///     </network>
void AddNetworkTags(XmlTagRegistry& tags);
/// … of keys, within <network>: <security keys="keys/robot"/>, a folder with the six files of SROS 2, each of which an
/// attribute may name instead.
void AddSecurityTag(XmlTagRegistry& tags);

}  // namespace runnel
