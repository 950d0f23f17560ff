#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/application_files/xml_tag.h"
#include "plugins/web_server/access_tokens.h"

namespace runnel {

/// Where an inspector is reached, and by whom, as files and command lines say it.
struct InspectorPlace {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;    ///< 0: any that is free
  std::string token = {};       ///< one or more, as ParseAccessTokens() has them; "": see WebServerOptions
  std::string token_file = {};  ///< that has more of them; "": none
  bool is_for_all_users = false;
  std::string certificate = {};  ///< file; "": nothing is encrypted
  std::string key = {};          ///< file; "": it is in the certificate's
  bool is_insecure = false;
  bool is_read_only = false;
};

/// The tokens that `place` names, and those of its file. Errors: those of ParseAccessTokens() and ReadAccessTokens().
[[nodiscard]] Result<std::vector<AccessToken>> TokensOf(const InspectorPlace& place);

/// Reads "[ADDRESS:]PORT": "8765", "0.0.0.0:8765", "[::]:0". Errors: no such address or port, and how
/// to write them.
[[nodiscard]] Result<InspectorPlace> ParseInspectorPlace(std::string_view text);
/// 0 .. 65535. Errors: it is none.
[[nodiscard]] Result<std::uint16_t> ParseNetworkPort(std::string_view text);

/// Adds what application files say of the inspector:
///
///     <inspector port="8765" address="127.0.0.1" read_only="false" token="…" token_file="…" all_users="false"
///                certificate="…" key="…" insecure="false"/>
void AddInspectorTag(XmlTagRegistry& tags);

/// What the application file says; nothing without <inspector>.
[[nodiscard]] std::optional<InspectorPlace> InspectorPlaceOf(const FrameworkElement& application);

}  // namespace runnel
