#include "core/paths/distant_ports.h"

namespace runnel {

Result<void> BringDistantPort(std::string_view path, const Port& to) {
  if (!IsDistantPath(path)) return {};
  DistantPorts* const ports = DistantPorts::FindIn(to);
  if (ports == nullptr) {
    return Error{.message = "'" + std::string(path) + "' is a port of another application, and this one has no network",
                 .hint = "add <network/> to the application, and to the other one what it offers"};
  }
  const auto made = ports->Make(path, to);
  return made ? Result<void>() : made.error();
}

}  // namespace runnel
