#include "plugins/web_server/access_rules.h"

#include <algorithm>
#include <cstdlib>
#include <locale>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <unistd.h>

#include "core/base/characters.h"
#include "core/base/number_text.h"

namespace runnel {

namespace {

constexpr std::string_view kTokenProtocol = "runnel.token.";

std::string Lower(std::string_view text) {
  return boost::algorithm::to_lower_copy(std::string(text), std::locale::classic());
}

/// What follows `start` in the first of the parts between separators that begins so; "" if none does.
std::string_view RestOfPart(std::string_view start, std::string_view parts, char separator) {
  while (!parts.empty()) {
    const std::size_t end = std::min(parts.find(separator), parts.size());
    const std::string_view part = Trimmed(parts.substr(0, end));
    if (part.starts_with(start)) return part.substr(start.size());
    parts.remove_prefix(std::min(end + 1, parts.size()));
  }
  return {};
}

std::string_view TokenInAuthorization(const WebRequest& request) {
  constexpr std::string_view kBearer = "bearer ";
  if (Lower(request.authorization.substr(0, kBearer.size())) != kBearer) return {};
  return Trimmed(request.authorization.substr(kBearer.size()));
}

bool IsAddress(std::string_view text) {
  // A zone ("fe80::1%eth0") may be any text, and stands in no address that browsers send.
  if (text.find('%') != std::string_view::npos) return false;
  boost::system::error_code error;
  boost::asio::ip::make_address(std::string(text), error);
  return !error;
}

// This process's, the system's, and who has asked the system's to start it.
std::vector<std::uint32_t> OwnUsers() {
  std::vector<std::uint32_t> users{geteuid(), 0};
  const char* const caller = geteuid() == 0 ? std::getenv("SUDO_UID") : nullptr;
  if (const auto user = NumberIn<std::uint32_t>(caller != nullptr ? caller : "")) {
    users.push_back(*user);
  }
  return users;
}

}  // namespace

std::string_view PathOf(std::string_view target) { return target.substr(0, target.find('?')); }

std::string_view HostNameOf(std::string_view host) {
  std::string_view name = host;
  std::string_view rest;
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    if (end == std::string_view::npos) return {};
    name = host.substr(1, end - 1);
    rest = host.substr(end + 1);
  } else {
    const std::size_t colon = host.find(':');
    name = host.substr(0, colon);
    rest = colon == std::string_view::npos ? std::string_view() : host.substr(colon);
  }
  if (rest.empty()) return name;
  const std::string_view port = rest.substr(1);
  const bool is_port = rest.front() == ':' && !port.empty() && port.size() <= 5 &&
                       std::ranges::all_of(port, [](char c) { return c >= '0' && c <= '9'; });
  return is_port ? name : std::string_view();
}

std::string_view TokenIn(const WebRequest& request) {
  const std::size_t question = request.target.find('?');
  if (question != std::string_view::npos) {
    const auto token = RestOfPart("token=", request.target.substr(question + 1), '&');
    if (!token.empty()) return token;
  }
  const auto token = RestOfPart(kTokenProtocol, request.protocols, ',');
  return token.empty() ? TokenInAuthorization(request) : token;
}

Result<bool> IsLoopback(const std::string& address) {
  boost::system::error_code error;
  const auto parsed = boost::asio::ip::make_address(address, error);
  if (!error) return parsed.is_loopback();
  return Error{.message = "'" + address + "' is not an address of a network",
               .hint = "write 127.0.0.1 for this machine only, or 0.0.0.0 for all networks"};
}

AccessRules::AccessRules(const WebServerOptions& options) : tokens_(options.tokens), origins_(options.origins) {
  names_.emplace_back("localhost");
  if (const auto is_loopback = IsLoopback(options.address); !is_loopback || !*is_loopback) {
    // Not on a loopback address, where nobody needs them: who is asked for them on a network can let them lead
    // here.
    boost::system::error_code ignored;
    if (const std::string name = Lower(boost::asio::ip::host_name(ignored)); !name.empty()) {
      names_.push_back(name);
      names_.push_back(name + ".local");
    }
  } else if (!options.is_for_all_users) {
    users_ = OwnUsers();
  }
  for (const std::string& name : options.host_names) names_.push_back(Lower(name));
}

bool AccessRules::IsKnownName(std::string_view host) const {
  const std::string_view name = HostNameOf(host);
  return !name.empty() && (IsAddress(name) || std::ranges::find(names_, Lower(name)) != names_.end());
}

std::optional<WebRole> AccessRules::RoleOf(std::string_view secret) const {
  std::optional<WebRole> role;
  // All are compared, so that the time does not tell which.
  for (const AccessToken& token : tokens_) {
    if (AreEqualSecrets(secret, token.secret)) role = token.role;
  }
  return role;
}

std::optional<AccessRules::Refusal> AccessRules::Check(const WebRequest& request) const {
  if (request.host.empty()) return Refusal{400, "the request does not say whom it asks (Host)"};
  if (!IsKnownName(request.host)) {
    return Refusal{421, "this server is not called '" + std::string(HostNameOf(request.host)) +
                            "'; call it by its address, or have it started with that name"};
  }
  if (!AsksForUser()) return {};
  if (!request.user) {
    return Refusal{403,
                   "the system does not say which user of this machine asks; start the program with "
                   "a token (--inspect-token-file)"};
  }
  if (std::ranges::find(users_, *request.user) != users_.end()) return {};
  return Refusal{403,
                 "this belongs to another user of this machine, who can start it with a token "
                 "(--inspect-token-file), or for all users (--inspect-all-users)"};
}

std::variant<WebRole, AccessRules::Refusal> AccessRules::Admit(const WebRequest& request) const {
  if (!tokens_.empty()) {
    if (const auto role = RoleOf(TokenIn(request))) return *role;
    return Refusal{401, TokenIn(request).empty()
                            ? "a token is needed: it stands behind #token= in the address that the program has printed"
                            : "this token is not known here"};
  }
  if (request.origin.empty()) return WebRole::kChange;
  const std::string origin = Lower(request.origin);
  const std::string host = Lower(request.host);
  const bool is_own = origin == "http://" + host || origin == "https://" + host;
  if (is_own || std::ranges::find(origins_, origin) != origins_.end()) return WebRole::kChange;
  return Refusal{403, "pages of '" + std::string(request.origin) +
                          "' may not talk to this server; it can be started with that origin allowed"};
}

}  // namespace runnel
