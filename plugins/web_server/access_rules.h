#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "plugins/web_server/access_tokens.h"
#include "plugins/web_server/web_server_options.h"

namespace runnel {

/// What a request says of where it comes from and where it believes to go, in the words of HTTP.
struct WebRequest {
  std::string_view target = {};         ///< "/?token=…"
  std::string_view host = {};           ///< "" if it has none
  std::string_view origin = {};         ///< "" if it has none: then it is no page that asks
  std::string_view authorization = {};  ///< "Bearer …"
  std::string_view protocols = {};      ///< "runnel.inspector.v1, runnel.token.…"
  /// Whose process asks, if it is one of this machine, as the system says.
  std::optional<std::uint32_t> user = {};
};

/// Who may ask, and for what. Nothing of the network is in here.
///
/// Threads:  any, once made.
class AccessRules {
 public:
  /// Of `options` what it says of tokens, names, origins and users.
  explicit AccessRules(const WebServerOptions& options);

  /// Why the request is refused, with the status of HTTP.
  struct Refusal {
    unsigned status;
    std::string text;  ///< for the person who asks
  };
  /// Of any request: the name of the server (a page of somebody else whose name leads here, by "DNS
  /// rebinding", calls it by that name); and, where no token is needed, the user.
  [[nodiscard]] std::optional<Refusal> Check(const WebRequest& request) const;
  /// Of one that wants to talk, besides: the token, or else where the page comes from: browsers let every page
  /// ask, and say which it is. A page that shows the token knows it, and may.
  [[nodiscard]] std::variant<WebRole, Refusal> Admit(const WebRequest& request) const;
  /// Whether somebody's user has to be known.
  [[nodiscard]] bool AsksForUser() const noexcept { return tokens_.empty() && !users_.empty(); }

 private:
  [[nodiscard]] bool IsKnownName(std::string_view host) const;
  [[nodiscard]] std::optional<WebRole> RoleOf(std::string_view secret) const;

  const std::vector<AccessToken> tokens_;
  std::vector<std::string> names_;
  const std::vector<std::string> origins_;
  std::vector<std::uint32_t> users_;  // who need no token; none: all
};

/// The part before '?'.
[[nodiscard]] std::string_view PathOf(std::string_view target);
/// The name of a host without the port, and without the brackets of IPv6; "" if it is malformed.
[[nodiscard]] std::string_view HostNameOf(std::string_view host);
/// The token that a request shows: in its address, among its protocols, or by Authorization. "": none.
[[nodiscard]] std::string_view TokenIn(const WebRequest& request);
/// Whether the address (of IPv4 or IPv6) is one that only this machine reaches. Errors: it is none.
[[nodiscard]] Result<bool> IsLoopback(const std::string& address);

}  // namespace runnel
