#pragma once

#include <string>
#include <vector>

namespace runnel::test {

/// Why recordings cannot be checked by @mcap/core here; "" if they can.
[[nodiscard]] std::string WhyNoOracle();

/// What one of the oracle's scripts prints. Fails the test with what it says if it does.
[[nodiscard]] std::string AskOracle(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace runnel::test
