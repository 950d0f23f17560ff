#include "plugins/web_server/internal/connection_registry.h"

#include <algorithm>

#include "core/base/retry.h"

namespace runnel::internal {

ConnectionRegistry::ConnectionRegistry(WebServerOptions options, AccessRules rules,
                                       const std::vector<WebResource>& resources, std::vector<WebProtocol> protocols)
    : options_(std::move(options)), rules_(std::move(rules)), resources_(resources), protocols_(std::move(protocols)) {}

// Beast needs memory where a context ends in which there are WebSockets.
ConnectionRegistry::~ConnectionRegistry() {
  Retry([this] { context_.shutdown(); });
}

const WebResource* ConnectionRegistry::FindResource(std::string_view path) const {
  const auto found = std::ranges::find(resources_, path, &WebResource::path);
  return found == resources_.end() ? nullptr : &*found;
}

const WebProtocol* ConnectionRegistry::FindProtocol(std::string_view name) const {
  const auto found = std::ranges::find_if(
      protocols_, [&](const WebProtocol& each) { return std::ranges::find(each.names, name) != each.names.end(); });
  return found == protocols_.end() ? nullptr : &*found;
}

std::string ConnectionRegistry::ProtocolNames() const {
  std::string names;
  for (const WebProtocol& protocol : protocols_) {
    for (const std::string& name : protocol.names) names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

void ConnectionRegistry::Add(const std::shared_ptr<WebConnection>& connection) {
  if (connections_.insert(connection).second && connection->is_session()) ++sessions_;
}

void ConnectionRegistry::Remove(const std::shared_ptr<WebConnection>& connection) noexcept {
  if (connections_.erase(connection) > 0 && connection->is_session()) --sessions_;
}

void ConnectionRegistry::RemoveLost() noexcept {
  for (;;) {
    const auto lost = std::ranges::find_if(connections_, [](const auto& each) { return each->is_lost(); });
    if (lost == connections_.end()) return;
    const std::shared_ptr<WebConnection> connection = *lost;
    connection->Remove();
  }
}

void ConnectionRegistry::AddVisitor(const std::shared_ptr<WebConnection>& visitor) {
  if (!connections_.insert(visitor).second || connections_.size() - sessions_.load() <= limits().visitors) return;
  std::shared_ptr<WebConnection> oldest;
  for (const auto& each : connections_) {
    if (each->is_session()) continue;
    if (oldest == nullptr || each->since() < oldest->since()) oldest = each;
  }
  oldest->Remove();
}

bool ConnectionRegistry::MakeRoomFor(WebRole role, bool is_kept) {
  std::size_t alike = 0;
  std::shared_ptr<WebConnection> least;
  for (const auto& each : connections_) {
    if (!each->is_session() || each->is_kept() != is_kept) continue;
    ++alike;
    if (each->role() >= role) continue;
    if (least == nullptr || std::pair(each->role(), each->since()) < std::pair(least->role(), least->since())) {
      least = each;
    }
  }
  if (alike < limits().clients) return true;
  if (least == nullptr) return false;
  least->End("somebody who may do more needs the place");
  least->GiveUpPlace();
  --sessions_;
  return true;
}

void ConnectionRegistry::ForEach(const std::function<void(WebConnection&)>& use) {
  const std::vector<std::shared_ptr<WebConnection>> now(connections_.begin(), connections_.end());
  for (const auto& each : now) use(*each);
}

void ConnectionRegistry::Clear() noexcept {
  for (const auto& each : connections_) each->Lose();
  RemoveLost();
}

}  // namespace runnel::internal
