#include "core/port/typed_ports.h"

#include <map>
#include <mutex>

namespace runnel {

namespace {
// Ports of several runtimes are made at once; a leaf among the locks.
struct KnownPorts {
  std::mutex mutex;
  std::map<const TypeInfo*, const TypedPorts*> by_type;
};

KnownPorts& Known() {
  static KnownPorts known;
  return known;
}
}  // namespace

// The first library that makes such ports makes them for all: it is never unloaded.
void internal::AddTypedPorts(const TypeInfo& type, const TypedPorts& ports) {
  const std::lock_guard lock(Known().mutex);
  Known().by_type.try_emplace(&type, &ports);
}

// What is compiled once.
template void internal::MakeTypedPortsKnown<bool>();
template void internal::MakeTypedPortsKnown<int>();
template void internal::MakeTypedPortsKnown<float>();
template void internal::MakeTypedPortsKnown<double>();
template void internal::MakeTypedPortsKnown<std::string>();

const TypedPorts* FindTypedPorts(const TypeInfo& type) {
  const std::lock_guard lock(Known().mutex);
  const auto found = Known().by_type.find(&type);
  return found == Known().by_type.end() ? nullptr : found->second;
}

namespace internal {
template class Distribution<QueuedReference>;
template class Distribution<QueuedCopy<1, 1>>;
template class Distribution<QueuedCopy<4, 4>>;
template class Distribution<QueuedCopy<8, 8>>;
template class Distribution<QueuedCopy<16, 8>>;
template class Distribution<QueuedCopy<24, 8>>;
template class Distribution<QueuedCopy<32, 8>>;
}  // namespace internal
}  // namespace runnel
