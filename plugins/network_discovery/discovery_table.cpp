#include "plugins/network_discovery/discovery_table.h"

#include <algorithm>

#include "plugins/network_discovery/value_form.h"

namespace runnel {

void DiscoveryTable::OnMember(const WireMember& member) {
  {
    const std::lock_guard lock(mutex_);
    members_[member.id] = member;
  }
  on_change_();
}

void DiscoveryTable::OnMemberGone(const WireId& id) {
  {
    const std::lock_guard lock(mutex_);
    members_.erase(id);
  }
  on_change_();
}

void DiscoveryTable::OnEndpoint(const WireEndpoint& endpoint) {
  {
    const std::lock_guard lock(mutex_);
    endpoints_[endpoint.id] = endpoint;
  }
  on_change_();
}

void DiscoveryTable::OnEndpointGone(const WireId& id) {
  {
    const std::lock_guard lock(mutex_);
    endpoints_.erase(id);
  }
  on_change_();
}

void DiscoveryTable::OnRefused(const std::string& why) {
  constexpr std::size_t kMost = 16;
  {
    const std::lock_guard lock(mutex_);
    if (refusals_.size() >= kMost || std::ranges::find(refusals_, why) != refusals_.end()) return;
    refusals_.push_back(why);
  }
  on_change_();
}

std::vector<std::string> DiscoveryTable::refusals() const {
  const std::lock_guard lock(mutex_);
  return refusals_;
}

std::vector<WireMember> DiscoveryTable::members() const {
  const std::lock_guard lock(mutex_);
  std::vector<WireMember> all;
  for (const auto& [id, member] : members_) all.push_back(member);
  return all;
}

std::vector<WireEndpoint> DiscoveryTable::endpoints() const {
  const std::lock_guard lock(mutex_);
  std::vector<WireEndpoint> all;
  for (const auto& [id, endpoint] : endpoints_) all.push_back(endpoint);
  return all;
}

std::vector<WireEndpoint> DiscoveryTable::Partners(const std::string& topic, bool writers) const {
  const std::lock_guard lock(mutex_);
  std::vector<WireEndpoint> found;
  for (const auto& [id, endpoint] : endpoints_) {
    if (!endpoint.is_own && endpoint.is_writer == writers && endpoint.options.topic == topic) found.push_back(endpoint);
  }
  return found;
}

std::optional<WireEndpoint> DiscoveryTable::FindWriter(std::uint64_t handle) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, endpoint] : endpoints_) {
    if (endpoint.is_writer && endpoint.handle == handle) return endpoint;
  }
  return {};
}

std::string DiscoveryTable::NameOf(const WireId& member) const {
  const std::lock_guard lock(mutex_);
  const auto found = members_.find(member);
  return found == members_.end() || found->second.name.empty() ? "somebody" : found->second.name;
}

std::string DiscoveryTable::ApplicationName(const WireId& member) const {
  const std::lock_guard lock(mutex_);
  const auto found = members_.find(member);
  const bool is_one = found != members_.end() && found->second.user_data.find(kIsApplication) != std::string::npos;
  return is_one ? found->second.name : "";
}

bool DiscoveryTable::HasSimulatedTime(const WireId& member) const {
  const std::lock_guard lock(mutex_);
  const auto found = members_.find(member);
  return found != members_.end() && found->second.user_data.find(kSimulatedTime) != std::string::npos;
}

bool IsInternalTopic(std::string_view topic) {
  return topic.ends_with("/runnel_structure") || topic.ends_with("/runnel_commands") || topic.ends_with("/runnel_replies");
}

std::string Misfit(const WireEndpointOptions& writer, const WireEndpointOptions& reader) {
  if (writer.type != reader.type) {
    return "the writer sends values of type " + writer.type + ", and the reader takes " + reader.type;
  }
  const std::string types = TypeMisfit(writer.user_data, reader.user_data);
  return types.empty() ? QosMisfit(writer.qos, reader.qos) : types;
}

}  // namespace runnel
