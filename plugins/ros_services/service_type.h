#pragma once

#include <string>

namespace runnel {

class MessageLibrary;
struct MessageDefinition;

/// What requests or responses of a service are on the wire.
struct ServiceType {
  std::string name = {};  ///< "std_srvs::srv::dds_::SetBool_Request_"
  std::string hash = {};  ///< "RIHS01_…" (TypeHashOf()), which others are told; "": they are not

  /// `library`: has the messages inside.
  [[nodiscard]] static ServiceType Of(const MessageDefinition& definition, const MessageLibrary& library);
  /// Of a message that ROS 2 has: "std_srvs/srv/SetBool_Request".
  [[nodiscard]] static ServiceType OfRos(const std::string& message);

  friend bool operator==(const ServiceType&, const ServiceType&) = default;
};

}  // namespace runnel
