#include "plugins/ros_services/service_type.h"

#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

ServiceType ServiceType::Of(const MessageDefinition& definition, const MessageLibrary& library) {
  return {DdsType(definition.name), TypeHashOf(definition, library)};
}

ServiceType ServiceType::OfRos(const std::string& message) {
  const MessageLibrary& library = MessageLibrary::Standard();
  return Of(*library.Find(message), library);
}

}  // namespace runnel
