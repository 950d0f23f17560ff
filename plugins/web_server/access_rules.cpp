#include "plugins/web_server/access_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <locale>
#include <utility>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/host_name.hpp>
#include <fmt/format.h>
#include <sys/random.h>

namespace runnel {

namespace {

constexpr std::size_t kShortestToken = 8;
constexpr std::size_t kLongestToken = 128;

std::string Lower(std::string_view text) {
  return boost::algorithm::to_lower_copy(std::string(text), std::locale::classic());
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// The value of `name` among "name=value" that `separator` keeps apart; "" if there is none.
std::string_view ValueOf(std::string_view name, std::string_view pairs, char separator) {
  while (!pairs.empty()) {
    const std::size_t end = std::min(pairs.find(separator), pairs.size());
    const std::string_view pair = Trimmed(pairs.substr(0, end));
    if (pair.size() > name.size() && pair.starts_with(name) && pair[name.size()] == '=') {
      return pair.substr(name.size() + 1);
    }
    pairs.remove_prefix(std::min(end + 1, pairs.size()));
  }
  return {};
}

std::string_view TokenInAddress(const WebRequest& request) {
  const std::size_t question = request.target.find('?');
  if (question == std::string_view::npos) return {};
  return ValueOf("token", request.target.substr(question + 1), '&');
}

std::string_view TokenInAuthorization(const WebRequest& request) {
  constexpr std::string_view kBearer = "bearer ";
  if (Lower(request.authorization.substr(0, kBearer.size())) != kBearer) return {};
  return Trimmed(request.authorization.substr(kBearer.size()));
}

bool IsAddress(std::string_view text) {
  boost::system::error_code error;
  boost::asio::ip::make_address(std::string(text), error);
  return !error;
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

bool AreEqualSecrets(std::string_view a, std::string_view b) {
  // Lengths may be told apart; they are no secret.
  if (a.size() != b.size()) return false;
  volatile unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = static_cast<unsigned char>(difference | (a[i] ^ b[i]));
  }
  return difference == 0;
}

Result<std::string> MakeToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return Error{.message = "no token can be made: the system has no random numbers",
                 .hint = "give one"};
  }
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

Result<void> CheckToken(std::string_view token) {
  const bool has_letters_of_addresses = std::ranges::all_of(token, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '_' ||
           c == '~';
  });
  if (has_letters_of_addresses && token.size() >= kShortestToken && token.size() <= kLongestToken) {
    return {};
  }
  return Error{.message = "the token cannot be used",
               .hint = "take 8 to 128 letters, digits and any of '-', '.', '_', '~'"};
}

Result<bool> IsLoopback(const std::string& address) {
  boost::system::error_code error;
  const auto parsed = boost::asio::ip::make_address(address, error);
  if (!error) return parsed.is_loopback();
  return Error{.message = "'" + address + "' is not an address of a network",
               .hint = "write 127.0.0.1 for this machine only, or 0.0.0.0 for all networks"};
}

AccessRules::AccessRules(std::string token, std::vector<std::string> names,
                         std::vector<std::string> origins, std::uint16_t port)
    : token_(std::move(token)),
      cookie_name_("runnel_token_" + std::to_string(port)),
      origins_(std::move(origins)) {
  names_.emplace_back("localhost");
  boost::system::error_code ignored;
  if (const std::string name = Lower(boost::asio::ip::host_name(ignored)); !name.empty()) {
    names_.push_back(name);
    names_.push_back(name + ".local");
  }
  for (const std::string& name : names) names_.push_back(Lower(name));
}

bool AccessRules::IsKnownName(std::string_view host) const {
  const std::string_view name = HostNameOf(host);
  return !name.empty() &&
         (IsAddress(name) || std::ranges::find(names_, Lower(name)) != names_.end());
}

bool AccessRules::ShowsToken(const WebRequest& request) const {
  return AreEqualSecrets(TokenInAddress(request), token_) ||
         AreEqualSecrets(TokenInAuthorization(request), token_);
}

std::optional<AccessRules::Refusal> AccessRules::Check(const WebRequest& request) const {
  if (request.host.empty()) return Refusal{400, "the request does not say whom it asks (Host)"};
  if (!IsKnownName(request.host)) {
    return Refusal{421, "this server is not called '" + std::string(HostNameOf(request.host)) +
                            "'; call it by its address"};
  }
  if (token_.empty() || ShowsToken(request) ||
      AreEqualSecrets(ValueOf(cookie_name_, request.cookie, ';'), token_)) {
    return {};
  }
  return Refusal{401, "a token is needed: open the address with ?token=… that the program printed"};
}

std::optional<AccessRules::Refusal> AccessRules::CheckOrigin(const WebRequest& request) const {
  if (request.origin.empty() || (!token_.empty() && ShowsToken(request))) return {};
  const std::string origin = Lower(request.origin);
  const std::string host = Lower(request.host);
  if (origin == "http://" + host || origin == "https://" + host) return {};
  if (std::ranges::find(origins_, origin) != origins_.end()) return {};
  return Refusal{403,
                 "pages of '" + std::string(request.origin) +
                     "' may not talk to this server; it can be started with that origin allowed"};
}

std::string AccessRules::CookieFor(const WebRequest& request) const {
  if (token_.empty() || !AreEqualSecrets(TokenInAddress(request), token_)) return {};
  return cookie_name_ + "=" + token_ + "; Path=/; HttpOnly; SameSite=Strict";
}

}  // namespace runnel
