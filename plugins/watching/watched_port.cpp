#include "plugins/watching/watched_port.h"

#include <algorithm>

namespace runnel {

Result<void> WatchedPort::Find(Runtime& runtime) {
  sources_.clear();
  const auto found = runtime.root().Find(path_);
  if (!found) return found.error();
  const auto* const port = dynamic_cast<const Port*>(*found);
  if (port == nullptr) return Error{.message = "this is not a port", .path = path_};
  if (port->serial() != serial_) shown_.reset();  // made anew: it counts from 0 again
  serial_ = port->serial();
  type_ = &port->type();
  if (port->is_proxy()) {
    const auto ends = port->Sources();
    sources_.assign(ends.begin(), ends.end());
  } else {
    sources_.push_back(port);
  }
  return {};
}

std::optional<std::uint64_t> WatchedPort::LookIfNew(const Port::Look& look) {
  std::uint64_t count = 0;
  // Before looking: what is published meanwhile may be shown twice, and is never missed.
  for (const Port* source : sources_) count += source->publications();
  if (shown_ == count) return {};
  const bool has_value =
      std::ranges::any_of(sources_, [&](const Port* source) { return source->LookAtValue(look); });
  if (!has_value) return {};
  shown_ = count;
  return count;
}

}  // namespace runnel
