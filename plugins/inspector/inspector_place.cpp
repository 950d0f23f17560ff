#include "plugins/inspector/inspector_place.h"

#include "core/base/number_text.h"
#include "plugins/web_server/access_rules.h"

namespace runnel {

Result<std::vector<AccessToken>> TokensOf(const InspectorPlace& place) {
  std::vector<AccessToken> tokens;
  if (!place.token.empty()) {
    auto said = ParseAccessTokens(place.token);
    if (!said) return said.error();
    tokens = std::move(*said);
  }
  if (!place.token_file.empty()) {
    auto read = ReadAccessTokens(place.token_file);
    if (!read) return read.error();
    tokens.insert(tokens.end(), read->begin(), read->end());
  }
  return tokens;
}

Result<std::uint16_t> ParseNetworkPort(std::string_view text) {
  if (const auto port = NumberIn<std::uint16_t>(text)) return *port;
  return Error{.message = "'" + std::string(text) + "' is not a port",
               .hint = "write a number from 1 to 65535, or 0 for any that is free"};
}

Result<InspectorPlace> ParseInspectorPlace(std::string_view text) {
  InspectorPlace place;
  // The last one: addresses of IPv6 have colons of their own, and stand in brackets.
  const std::size_t colon = text.rfind(':');
  const auto port =
      ParseNetworkPort(colon == std::string_view::npos ? text : text.substr(colon + 1));
  if (!port) return port.error();
  place.port = *port;
  if (colon == std::string_view::npos) return place;
  std::string_view address = text.substr(0, colon);
  if (address.starts_with('[') && address.ends_with(']')) {
    address = address.substr(1, address.size() - 2);
  }
  place.address = address == "localhost" ? "127.0.0.1" : std::string(address);
  if (const auto known = IsLoopback(place.address); !known) return known.error();
  return place;
}

}  // namespace runnel
