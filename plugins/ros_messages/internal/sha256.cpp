#include "plugins/ros_messages/internal/sha256.h"

#include <array>

#include <openssl/sha.h>

namespace runnel::internal {

std::string Sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::string digits;
  for (const unsigned char each : digest) digits += {"0123456789abcdef"[each >> 4], "0123456789abcdef"[each & 15]};
  return digits;
}

}  // namespace runnel::internal
