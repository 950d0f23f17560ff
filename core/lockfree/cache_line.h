#pragma once

#include <cstddef>

namespace runnel {

/// Data written by different threads is kept this many bytes apart. A constant of ours, because the
/// standard's hardware_destructive_interference_size may differ between a library and its plugin.
inline constexpr std::size_t kCacheLineSize = 64;

}  // namespace runnel
