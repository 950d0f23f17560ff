#include "core/port/proxy_port.h"

#include <algorithm>
#include <mutex>

#include "core/element/runtime.h"

namespace runnel {

ProxyPort::ProxyPort(const Placement& placement, Direction direction, const TypeInfo& type,
                     std::string description)
    : Port(placement, direction, type, std::move(description)) {}

bool ProxyPort::VisitLatest(const Visitor& visit) const {
  const std::lock_guard lock(runtime().structure_mutex());
  return std::ranges::any_of(Sources(), [&](Port* source) { return source->VisitLatest(visit); });
}

std::uint64_t ProxyPort::publications() const noexcept {
  const std::lock_guard lock(runtime().structure_mutex());
  std::uint64_t all = 0;
  for (const Port* source : Sources()) all += source->publications();
  return all;
}

}  // namespace runnel
