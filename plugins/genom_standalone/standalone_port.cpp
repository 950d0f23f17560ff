#include "plugins/genom_standalone/standalone_port.h"

namespace runnel::genom_standalone {

void StandalonePort::Fetch() {
  const std::lock_guard lock(mutex_);
  if (!has_newest_) return;
  data_.Set(newest_.data());
  has_data_ = true;
}

void StandalonePort::Write() { Put(data_.data()); }

void StandalonePort::Put(const void* value) {
  const std::lock_guard lock(mutex_);
  newest_.Set(value);
  has_newest_ = true;
}

StandalonePort* StandaloneMultiplePort::Find(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = ports_.find(name);
  return found != ports_.end() ? found->second.get() : nullptr;
}

StandalonePort& StandaloneMultiplePort::Open(const std::string& name) {
  const std::lock_guard lock(mutex_);
  auto& port = ports_[name];
  if (port == nullptr) port = std::make_unique<StandalonePort>(type_, is_input_);
  return *port;
}

bool StandaloneMultiplePort::Close(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return ports_.erase(name) > 0;
}

}  // namespace runnel::genom_standalone
