#include "core/plugin/abi.h"

namespace runnel {

const char* CoreAbiFingerprint() noexcept { return kAbiFingerprint; }

}  // namespace runnel
