#pragma once

#include <random>
#include <string>
#include <vector>

namespace runnel::test {

/// A description with a few mistakes put in at random: bytes changed, pieces left out, doubled, taken from another
/// description, words of the language in the wrong places.
[[nodiscard]] std::string Mutated(const std::vector<std::string>& seeds, std::mt19937& random);

}  // namespace runnel::test
