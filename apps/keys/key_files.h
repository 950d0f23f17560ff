#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace runnel {

/// Makes who signs the keys of a set of applications, and what they encrypt, in a folder: ca.cert.pem, ca.key.pem and
/// governance.p7s. What is there stays. Errors: the program openssl, or the system.
Result<void> MakeAuthority(const std::filesystem::path& folder, int days);

/// Makes the six files of one application in a folder of its name, by the authority of `folder`: those of SROS 2. False: they
/// are there, and stay. Errors: a name that is none; the program openssl, or the system.
Result<bool> MakeKeys(const std::filesystem::path& folder, const std::string& name, int days);

}  // namespace runnel
