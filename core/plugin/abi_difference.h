#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// Why code that was built with one fingerprint (`abi.h`) cannot use classes of another, for people.
struct AbiDifference {
  std::string why;   ///< "it is built for AVX-512, this core is not"
  std::string cure;  ///< "build the plugin without -march=native, -mavx512f and the like"
};

/// What differs between the fingerprint of a plugin and that of the core; the compiler, where none of its flags
/// does. Any thread; allocates.
[[nodiscard]] AbiDifference FindAbiDifference(std::string_view plugin, std::string_view core);

}  // namespace runnel
