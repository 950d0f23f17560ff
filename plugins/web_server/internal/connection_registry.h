#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <boost/asio/io_context.hpp>

#include "core/base/retry.h"
#include "plugins/web_server/access_rules.h"
#include "plugins/web_server/web_server_options.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// The server's end of one connection.
class WebConnection {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  virtual ~WebConnection() = default;
  /// For sessions; others have nothing to do.
  virtual void Poll() {}
  /// Ends it in order, if its protocol has an order to end in.
  virtual void End(std::string_view /*reason*/) { Cut(); }
  /// Ends it at once; it is removed when it hears of that.
  virtual void Cut() noexcept = 0;
  /// It has ended, with its session.
  virtual void Remove() = 0;
  /// Of a session that is to end soon: it is none any more.
  void GiveUpPlace() noexcept { role_.reset(); }

  [[nodiscard]] bool is_session() const noexcept { return role_.has_value(); }
  /// Of a session.
  [[nodiscard]] WebRole role() const noexcept { return role_.value_or(WebRole::kLook); }
  /// Of a session whose place is kept for those like it.
  [[nodiscard]] bool is_kept() const noexcept { return is_kept_; }
  [[nodiscard]] SteadyTime since() const noexcept { return since_; }

  /// It will not hear of one of its operations, and maybe of nothing any more.
  void Lose() noexcept {
    is_lost_ = true;
    Cut();
  }
  [[nodiscard]] bool is_lost() const noexcept { return is_lost_; }

 protected:
  /// `role`: of a session; nothing: it is none.
  explicit WebConnection(std::optional<WebRole> role, bool is_kept = false) : role_(role), is_kept_(is_kept) {}

 private:
  std::optional<WebRole> role_;
  const bool is_kept_;
  const SteadyTime since_ = std::chrono::steady_clock::now();
  bool is_lost_ = false;
};

/// For whoever is called by the server's thread, beneath which nobody catches anything: who throws, for want of memory, ends its
/// own connection and no other.
template <typename Connection, typename Do>
void OrRemove(Connection& connection, const Do& act) noexcept {
  try {
    act();
  } catch (...) {
    connection.Remove();
  }
}

/// What Asio and Beast call when an operation of `connection` has ended: `act(connection, results…)`. Where they find no
/// memory themselves they drop it instead, and the connection is lost: nothing would be read of it any more, and nobody
/// would know.
template <typename Connection, typename Act>
class Handler {
 public:
  Handler(Connection& connection, Act act) : connection_(connection.shared_from_this()), act_(std::move(act)) {}
  Handler(Handler&&) noexcept = default;
  ~Handler() {
    // Not removed here: it may be its session that is being called.
    if (connection_ != nullptr) connection_->Lose();
  }
  template <typename... Results>
  void operator()(Results... results) {
    const auto connection = std::move(connection_);
    OrRemove(*connection, [&] { std::invoke(act_, *connection, results...); });
  }

 private:
  std::shared_ptr<Connection> connection_;  // nullptr: it has been called, or moved
  Act act_;
};

/// What the connections of one server share. Threads: the server's; `sessions` any.
class ConnectionRegistry {
 public:
  ConnectionRegistry(WebServerOptions options, AccessRules rules, const std::vector<WebResource>& resources,
                     std::vector<WebProtocol> protocols)
      : options_(std::move(options)),
        rules_(std::move(rules)),
        resources_(resources),
        protocols_(std::move(protocols)) {}

  // Beast needs memory where a context ends in which there are WebSockets.
  ~ConnectionRegistry() {
    Retry([this] { context_.shutdown(); });
  }

  [[nodiscard]] boost::asio::io_context& context() noexcept { return context_; }
  [[nodiscard]] const WebLimits& limits() const noexcept { return options_.limits; }
  [[nodiscard]] const AccessRules& rules() const noexcept { return rules_; }

  [[nodiscard]] const WebResource* FindResource(std::string_view path) const {
    const auto found = std::ranges::find(resources_, path, &WebResource::path);
    return found == resources_.end() ? nullptr : &*found;
  }

  /// By name. `name`, if found, is the server's copy.
  [[nodiscard]] const WebProtocol* FindProtocol(std::string_view name) const {
    const auto found = std::ranges::find_if(
        protocols_, [&](const WebProtocol& each) { return std::ranges::find(each.names, name) != each.names.end(); });
    return found == protocols_.end() ? nullptr : &*found;
  }

  /// "a, b, c".
  [[nodiscard]] std::string ProtocolNames() const {
    std::string names;
    for (const WebProtocol& protocol : protocols_) {
      for (const std::string& name : protocol.names) names += (names.empty() ? "" : ", ") + name;
    }
    return names;
  }

  void Add(const std::shared_ptr<WebConnection>& connection) {
    if (connections_.insert(connection).second && connection->is_session()) ++sessions_;
  }

  void Remove(const std::shared_ptr<WebConnection>& connection) noexcept {
    if (connections_.erase(connection) > 0 && connection->is_session()) --sessions_;
  }

  /// Those that will not hear by themselves that they have been cut.
  void RemoveLost() noexcept {
    for (;;) {
      const auto lost = std::ranges::find_if(connections_, [](const auto& each) { return each->is_lost(); });
      if (lost == connections_.end()) return;
      const std::shared_ptr<WebConnection> connection = *lost;
      connection->Remove();
    }
  }

  /// One that is no session, unless it is there already. If there are too many, the one that has been there for the longest
  /// time goes.
  void AddVisitor(const std::shared_ptr<WebConnection>& visitor) {
    if (!connections_.insert(visitor).second || connections_.size() - sessions_.load() <= limits().visitors) return;
    std::shared_ptr<WebConnection> oldest;
    for (const auto& each : connections_) {
      if (each->is_session()) continue;
      if (oldest == nullptr || each->since() < oldest->since()) oldest = each;
    }
    oldest->Remove();
  }

  /// Whether there is a place for one more session; if there is none, the oldest that may do less makes room. Of those whose
  /// places are kept, or of the others.
  bool MakeRoomFor(WebRole role, bool is_kept) {
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

  [[nodiscard]] std::size_t sessions() const noexcept { return sessions_.load(); }
  [[nodiscard]] std::size_t connections() const noexcept { return connections_.size(); }

  /// Also for those that come and go meanwhile.
  void ForEach(const std::function<void(WebConnection&)>& use) {
    const std::vector<std::shared_ptr<WebConnection>> now(connections_.begin(), connections_.end());
    for (const auto& each : now) use(*each);
  }

  /// No connection is left; the sessions are destroyed.
  void Clear() noexcept {
    for (const auto& each : connections_) each->Lose();
    RemoveLost();
  }

 private:
  struct Context : boost::asio::io_context {
    using io_context::io_context;
    using io_context::shutdown;
  };

  Context context_{1};
  const WebServerOptions options_;
  const AccessRules rules_;
  const std::vector<WebResource> resources_;
  const std::vector<WebProtocol> protocols_;
  std::unordered_set<std::shared_ptr<WebConnection>> connections_;
  std::atomic<std::size_t> sessions_{0};
};

}  // namespace runnel::internal
