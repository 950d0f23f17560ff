#pragma once

#include <string>

#include "plugins/wire/wire.h"

namespace runnel {

/// A hint for an engine that has joined no network with these keys and does not say which file is wrong.
[[nodiscard]] inline std::string KeyFilesHint(const WireSecurity& security) {
  return "the key must be that of the certificate, and that of the authority: look at " + security.certificate + ", " + security.key + ", " +
         security.identity_ca + "; the other two signed by " + security.permissions_ca + ": " + security.governance + ", " + security.permissions;
}

}  // namespace runnel
