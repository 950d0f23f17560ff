#include "plugins/web_server/internal/hub.h"

#include <algorithm>
#include <utility>

namespace runnel::internal {

namespace {

std::unordered_map<std::string_view, WebResource> ByPath(
    const std::vector<WebResource>& resources) {
  std::unordered_map<std::string_view, WebResource> by_path;
  for (const WebResource& each : resources) by_path.emplace(each.path, each);
  return by_path;
}

}  // namespace

WebHub::WebHub(WebServerOptions options, AccessRules rules,
               const std::vector<WebResource>& resources, std::vector<WebProtocol> protocols)
    : options_(std::move(options)),
      rules_(std::move(rules)),
      resources_(ByPath(resources)),
      protocols_(std::move(protocols)) {}

const WebResource* WebHub::FindResource(std::string_view path) const {
  const auto found = resources_.find(path);
  return found == resources_.end() ? nullptr : &found->second;
}

const WebProtocol* WebHub::FindProtocol(std::string_view name) const {
  const auto found = std::ranges::find_if(protocols_, [&](const WebProtocol& each) {
    return std::ranges::find(each.names, name) != each.names.end();
  });
  return found == protocols_.end() ? nullptr : &*found;
}

std::string WebHub::ProtocolNames() const {
  std::string names;
  for (const WebProtocol& protocol : protocols_) {
    for (const std::string& name : protocol.names) names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

void WebHub::Add(std::shared_ptr<WebConnection> connection) {
  if (connection->is_conversation()) ++conversations_;
  connections_.insert(std::move(connection));
}

void WebHub::Remove(const std::shared_ptr<WebConnection>& connection) noexcept {
  if (connections_.erase(connection) > 0 && connection->is_conversation()) --conversations_;
}

void WebHub::MakeRoom() {
  if (connections_.size() - conversations_.load() < limits().visitors) return;
  std::shared_ptr<WebConnection> oldest;
  for (const auto& each : connections_) {
    if (each->is_conversation()) continue;
    if (oldest == nullptr || each->since() < oldest->since()) oldest = each;
  }
  if (oldest == nullptr) return;
  oldest->Cut();
  Remove(oldest);
}

void WebHub::ForEach(const std::function<void(WebConnection&)>& use) {
  const std::vector<std::shared_ptr<WebConnection>> now(connections_.begin(), connections_.end());
  for (const auto& each : now) use(*each);
}

void WebHub::Clear() noexcept {
  for (const auto& each : connections_) each->Detach();
  connections_.clear();
  conversations_.store(0);
}

}  // namespace runnel::internal
