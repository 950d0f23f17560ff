#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/web_server/web_session.h"

namespace runnel {

/// A secret, and what who shows it may do.
struct AccessToken {
  WebRole role = WebRole::kChange;
  std::string secret;

  bool operator==(const AccessToken&) const = default;
};

/// Reads "TOKEN", which may change, or "ROLE:TOKEN", several with blanks or ends of lines between them: "look:r3d-car
/// drive:gr33n-car". Of lines, what follows '#' is a comment.
/// Errors: no token, no such role (with the nearest), one that is too short or has characters that do not go into
/// an address, one for two roles. No error repeats a token.
[[nodiscard]] Result<std::vector<AccessToken>> ParseAccessTokens(std::string_view text);
/// The same from a file. Errors, besides: it cannot be read, or others than its owner and its group may read it.
[[nodiscard]] Result<std::vector<AccessToken>> ReadAccessTokens(const std::filesystem::path& file);
/// 128 random bits as text. Errors: the system has none.
[[nodiscard]] Result<std::string> MakeToken();
/// Takes a time that does not depend on where they differ.
[[nodiscard]] bool AreEqualSecrets(std::string_view a, std::string_view b);

/// Errors: it is no file, cannot be read, or everybody may read it.
[[nodiscard]] Result<void> CheckSecretFile(const std::filesystem::path& file);

}  // namespace runnel
