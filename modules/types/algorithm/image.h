#pragma once

#include <cstdint>
#include <string>

#include "core/base/shared_vector.h"

namespace runnel {

/// A picture, row by row from the top, pixels from the left.
struct Image {
  std::uint32_t width = 0;          ///< pixels
  std::uint32_t height = 0;         ///< pixels
  std::string encoding;             ///< of a pixel: "rgb8", "bgr8", "rgba8", "mono8", "mono16", …
  std::uint32_t row_stride = 0;     ///< bytes from the begin of a row to that of the next
  SharedVector<std::uint8_t> data;  ///< row_stride * height bytes

  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace runnel
