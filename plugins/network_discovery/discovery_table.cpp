#include "plugins/network_discovery/discovery_table.h"

#include <algorithm>

#include "core/base/characters.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/network_discovery/value_form.h"

namespace runnel {

template <typename Do>
void DiscoveryTable::Change(const Do& change) {
  {
    const std::lock_guard lock(mutex_);
    change();
  }
  on_change_();
}

void DiscoveryTable::OnMember(const WireMember& member) {
  Change([&] { members_[member.id] = {member.id, Printable(member.name), Printable(member.user_data)}; });
}
void DiscoveryTable::OnMemberGone(const WireId& id) {
  Change([&] {
    members_.erase(id);
    nodes_.erase(id);
  });
}
// Up to Humble ids are filled up to 24 octets by 0. From Iron on that is where the count of nodes stands, and the size of the
// first one's name; without nodes there is less.
void DiscoveryTable::OnNodes(std::span<const std::byte> octets) {
  constexpr std::size_t kHeader = 4, kFill = 8;
  WireId member{};
  std::string all, name_space, name;
  auto from = CdrReader::Begin(octets);
  if (!from || !from->GetPlain(member.data(), 1, member.size())) return;
  const auto behind = octets.subspan(kHeader + member.size());
  const bool is_filled = behind.size() > kFill && std::ranges::count(behind.first(kFill), std::byte{0}) == kFill;
  const std::size_t id_size = member.size() + (is_filled ? kFill : 0);
  if (is_filled && !from->Skip(1, kFill)) return;
  const auto skip_ids = [&] {
    const auto count = from->GetCount(id_size);
    return count && from->Skip(1, *count * id_size);
  };
  for (std::size_t left = from->GetCount(1).value_or(0); left > 0; --left) {
    if (!from->GetText(name_space) || !from->GetText(name) || !skip_ids() || !skip_ids()) return;
    all += (all.empty() ? "" : ", ") + name_space + (name_space.ends_with('/') ? "" : "/") + name;
  }
  Change([&] {
    if (members_.contains(member)) nodes_[member] = Printable(all);
  });
}
void DiscoveryTable::OnEndpoint(const WireEndpoint& endpoint) {
  WireEndpoint known = endpoint;  // as a whole, or not at all
  for (std::string* const text :
       {&known.options.topic, &known.options.type, &known.options.user_data, &known.options.unmet})
    *text = Printable(*text);
  Change([&] { endpoints_.insert_or_assign(endpoint.id, std::move(known)); });
}
void DiscoveryTable::OnMissed() noexcept {
  has_missed_.store(true, std::memory_order_relaxed);  // relaxed: it guards no memory
  on_change_();
}
void DiscoveryTable::OnEndpointGone(const WireId& id) {
  Change([&] { endpoints_.erase(id); });
}
void DiscoveryTable::OnRefused(const std::string& said) {
  constexpr std::size_t kMost = 16;
  const std::string why = Printable(said);
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

WireMember DiscoveryTable::FindMember(const WireId& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = members_.find(id);
  return found != members_.end() ? found->second : WireMember{};
}

// Applications of Runnel have names of their own.
std::string DiscoveryTable::NameOf(const WireId& member) const {
  const std::string own = FindMember(member).name;
  const std::lock_guard lock(mutex_);
  const auto nodes = nodes_.find(member);
  if ((own.empty() || own == "/") && nodes != nodes_.end() && !nodes->second.empty()) return nodes->second;
  return own.empty() ? "somebody" : own;
}

std::string DiscoveryTable::ApplicationName(const WireId& member) const {
  const WireMember found = FindMember(member);
  return found.user_data.find(kIsApplication) != std::string::npos ? found.name : "";
}

bool DiscoveryTable::HasSimulatedTime(const WireId& member) const {
  return FindMember(member).user_data.find(kSimulatedTime) != std::string::npos;
}

bool IsInternalTopic(std::string_view topic) {
  return topic.ends_with("/runnel_structure") || topic.ends_with("/runnel_commandsRequest") ||
         topic.ends_with("/runnel_commandsReply");
}

std::string Misfit(const WireEndpointOptions& writer, const WireEndpointOptions& reader) {
  if (writer.type != reader.type) {
    return "the writer sends values of type " + writer.type + ", and the reader takes " + reader.type;
  }
  const std::string types = TypeMisfit(writer.user_data, reader.user_data);
  if (!types.empty()) return types;
  if (!writer.unmet.empty()) return "the writer has what is not taken here: " + writer.unmet;
  return reader.unmet.empty() ? QosMisfit(writer.qos, reader.qos)
                              : "the reader asks for what is not offered here: " + reader.unmet;
}

}  // namespace runnel
