#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/type_builder.h"

namespace runnel::bench {

/// 128 bytes, as FINROC's papers have it.
struct Matrix4 {
  std::array<double, 16> elements;
};
inline void Describe(TypeBuilder<Matrix4>& type) { type.Name("bench/Matrix4"); }

/// 128 bytes that say which they are, and when they were sent.
struct Message {
  std::uint64_t number;
  std::int64_t sent;  // ns
  std::array<std::uint64_t, 14> content;
};
inline void Describe(TypeBuilder<Message>& type) { type.Name("bench/Message"); }

inline constexpr std::size_t kImageSize = 1920 * 1080 * 3;

struct Image {
  std::uint64_t number = 0;
  std::vector<unsigned char> pixels;
};
inline void Describe(TypeBuilder<Image>& type) { type.Name("bench/Image"); }

template <std::size_t kSize>
struct Payload {
  std::array<unsigned char, kSize> bytes;
};
template <std::size_t kSize>
void Describe(TypeBuilder<Payload<kSize>>& type) {
  type.Name("bench/Payload" + std::to_string(kSize));
}

}  // namespace runnel::bench
