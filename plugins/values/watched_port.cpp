#include "plugins/values/watched_port.h"

#include <algorithm>

#include "core/port/input_base.h"

namespace runnel {

namespace {

// A port that publishes during a look is looked at again, but not for ever.
constexpr int kLooks = 3;

std::uint64_t CountOf(const std::vector<const Port*>& ports) {
  std::uint64_t count = 0;
  for (const Port* port : ports) count += port->publications();
  return count;
}

}  // namespace

Result<void> WatchedPort::Find(Runtime& runtime) {
  sources_.clear();
  input_ = nullptr;
  const auto found = runtime.root().Find(path_);
  if (!found) return found.error();
  const auto* const port = dynamic_cast<const Port*>(*found);
  if (port == nullptr) return Error{.message = "this is not a port", .path = path_};
  if (port->id() != id_) shown_.reset();  // made anew: it counts from 0 again
  id_ = port->id();
  port_ = port;
  type_ = &port->type();
  input_ = dynamic_cast<const InputBase*>(port);
  sources_ = port->ShownPorts();
  return {};
}

std::optional<std::uint64_t> WatchedPort::VisitIfNew(const Port::Visitor& look) {
  for (const Port* source : sources_) source->NoteLook();
  std::uint64_t count = CountOf(sources_);
  if (shown_ == count) return {};
  for (int looks = kLooks; looks > 0; --looks) {
    const bool has_value = std::ranges::any_of(
        sources_, [&](const Port* source) { return source->VisitLatest(look); });
    if (!has_value) return {};
    const std::uint64_t after = CountOf(sources_);
    if (after == count) break;
    // What was published meanwhile may have been shown, or not. After the last look, the count of before:
    // what may be shown twice is never missed.
    if (looks > 1) count = after;
  }
  shown_ = count;
  return count;
}

std::uint64_t WatchedPort::dropped() const noexcept {
  return input_ == nullptr ? 0 : input_->dropped();
}

}  // namespace runnel
