#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/web_server/web_server_options.h"

namespace runnel {

/// What a request says of where it comes from and where it believes to go, in the words of HTTP.
struct WebRequest {
  std::string_view target = {};         ///< "/page.js?token=…"
  std::string_view host = {};           ///< "" if it has none
  std::string_view origin = {};         ///< "" if it has none: then it is no page that asks
  std::string_view cookie = {};         ///< all of them
  std::string_view authorization = {};  ///< "Bearer …"
};

/// Who may ask. Nothing of the network is in here.
///
/// Threads:  any, once made.
class AccessRules {
 public:
  /// `token`: what clients must show; "": nothing. `names`, `origins`: see WebServerOptions.
  AccessRules(std::string token, std::vector<std::string> names, std::vector<std::string> origins,
              std::uint16_t port);

  /// Why the request is refused, with the status of HTTP.
  struct Refusal {
    unsigned status;
    std::string text;  ///< for the person who asks
  };
  /// Of any request: the name of the server (a page of somebody else whose name leads here, by "DNS
  /// rebinding", calls it by that name), and the token.
  [[nodiscard]] std::optional<Refusal> Check(const WebRequest& request) const;
  /// Of one that wants a WebSocket, besides: browsers let every page ask, and say which it is. A page
  /// that shows the token itself, and not by a cookie, knows it, and may.
  [[nodiscard]] std::optional<Refusal> CheckOrigin(const WebRequest& request) const;

  /// To be set as a cookie, after the token was in the address: "" if it was not.
  [[nodiscard]] std::string CookieFor(const WebRequest& request) const;

 private:
  [[nodiscard]] bool IsKnownName(std::string_view host) const;
  [[nodiscard]] bool ShowsToken(const WebRequest& request) const;

  const std::string token_;
  const std::string cookie_name_;
  std::vector<std::string> names_;
  const std::vector<std::string> origins_;
};

/// The part before '?'.
[[nodiscard]] std::string_view PathOf(std::string_view target);
/// The name of a host without the port, and without the brackets of IPv6; "" if it is malformed.
[[nodiscard]] std::string_view HostNameOf(std::string_view host);
/// Takes a time that does not depend on where they differ.
[[nodiscard]] bool AreEqualSecrets(std::string_view a, std::string_view b);
/// 128 random bits as text. Errors: the system has none.
[[nodiscard]] Result<std::string> MakeToken();
/// Errors: it is too short to be one, or has characters that do not go into an address.
Result<void> CheckToken(std::string_view token);
/// Whether the address (of IPv4 or IPv6) is one that only this machine reaches. Errors: it is none.
[[nodiscard]] Result<bool> IsLoopback(const std::string& address);

}  // namespace runnel
