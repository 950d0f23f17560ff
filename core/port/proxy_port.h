#pragma once

#include "core/port/port.h"

namespace runnel {

/// A port in the interface of a group. It holds no data: whoever is connected inside is bound to
/// whoever is connected outside, so that passing through a hundred groups costs nothing.
///
/// Threads: see Port.
class ProxyPort final : public Port {
 public:
  ProxyPort(const Placement& placement, Direction direction, const TypeInfo& type, std::string description = {});
  ~ProxyPort() override { DisconnectAll(); }

  [[nodiscard]] bool is_proxy() const noexcept override { return true; }
};

}  // namespace runnel
