#include "core/port/proxy_port.h"

namespace runnel {

ProxyPort::ProxyPort(const Placement& placement, Direction direction, const TypeInfo& type,
                     std::string description)
    : Port(placement, direction, type, std::move(description)) {}

}  // namespace runnel
