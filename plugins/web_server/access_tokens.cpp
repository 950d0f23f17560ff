#include "plugins/web_server/access_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/ranges.h>
#include <openssl/crypto.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

namespace runnel {

namespace {

constexpr std::size_t kShortestToken = 8;
constexpr std::size_t kLongestToken = 128;

bool IsGoodToken(std::string_view token) {
  const bool has_letters_of_addresses = std::ranges::all_of(token, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' || c == '_' || c == '~';
  });
  return has_letters_of_addresses && token.size() >= kShortestToken && token.size() <= kLongestToken;
}

Result<AccessToken> ParseToken(std::string_view word) {
  AccessToken token;
  const std::size_t colon = word.find(':');
  if (colon != std::string_view::npos) {
    const std::string_view name = word.substr(0, colon);
    const auto role = WebRoleNamed(name);
    if (!role) {
      return Error{.message = "a token's role is none", .hint = "write look:TOKEN, drive:TOKEN or change:TOKEN"};
    }
    token.role = *role;
    word.remove_prefix(colon + 1);
  }
  token.secret = word;
  if (IsGoodToken(word)) return token;
  return Error{.message = "the token cannot be used",
               .hint = "take 8 to 128 letters, digits and any of '-', '.', '_', '~'"};
}

}  // namespace

Result<std::vector<AccessToken>> ParseAccessTokens(std::string_view text) {
  std::vector<AccessToken> tokens;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    for (std::string word; words >> word;) {
      auto token = ParseToken(word);
      if (!token) return token.error();
      if (std::ranges::find(tokens, token->secret, &AccessToken::secret) != tokens.end()) {
        return Error{.message = "a token is there twice", .hint = "take another one for each role"};
      }
      tokens.push_back(std::move(*token));
    }
  }
  if (!tokens.empty()) return tokens;
  return Error{.message = "there is no token", .hint = "write TOKEN, or ROLE:TOKEN for each role"};
}

Result<void> CheckSecretFile(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return SystemError("cannot be read", file);
  if (S_ISDIR(status.st_mode)) {
    return Error{.message = "is a folder, not a file", .position = {file.string()}};
  }
  if ((status.st_mode & S_IROTH) != 0) {
    return Error{.message = "everybody on this machine may read it",
                 .position = {file.string()},
                 .hint = "keep it for yourself: chmod 600 '" + file.string() + "'"};
  }
  if (access(file.c_str(), R_OK) != 0) return SystemError("cannot be read", file);
  return {};
}

Result<std::vector<AccessToken>> ReadAccessTokens(const std::filesystem::path& file) {
  if (const auto checked = CheckSecretFile(file); !checked) return checked.error();
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  auto tokens = ParseAccessTokens(text);
  if (tokens) return tokens;
  return tokens.error().WithPosition(file.string());
}

Result<std::string> MakeToken() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    return Error{.message = "no token can be made: the system has no random numbers", .hint = "give one"};
  }
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

bool AreEqualSecrets(std::string_view a, std::string_view b) {
  // Lengths may be told apart; they are no secret.
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace runnel
