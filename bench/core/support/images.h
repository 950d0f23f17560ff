#pragma once

#include <memory>

#include "bench/core/support/payloads.h"
#include "core/port/output.h"

namespace runnel::bench {

inline std::shared_ptr<Image> MakeImage() {
  auto image = std::make_shared<Image>();
  image->pixels.resize(kImageSize);
  return image;
}

/// Gives every buffer of the output's pool its pixels, so that nothing is allocated later.
inline void PrepareImages(Output<Image>& output) {
  output.PrepareBuffers([](Image& image) { image.pixels.resize(kImageSize); });
}

}  // namespace runnel::bench
