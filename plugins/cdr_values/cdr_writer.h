#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>
#include <vector>

namespace runnel {

/// Puts numbers, texts and lists of numbers one behind the other as "plain CDR" (XCDR1), in the machine's order of octets:
/// each number is aligned to its size, counted from behind the four octets of the encapsulation header.
///
/// Ownership:   writes into a vector of the caller's, which keeps its memory from value to value.
/// Allocation:  as far as the vector has to grow.
class CdrWriter {
 public:
  static constexpr std::size_t kHeader = 4;

  /// What was in `octets` is replaced by the header.
  explicit CdrWriter(std::vector<std::byte>& octets) : octets_(octets) {
    constexpr bool is_little = std::endian::native == std::endian::little;
    octets.assign({std::byte{0}, std::byte{is_little}, std::byte{0}, std::byte{0}});
  }

  template <typename T>
  requires std::is_arithmetic_v<T>
  void Put(T value) { PutPlain(&value, sizeof value, 1); }

  /// Of a list whose length is not part of its type; its elements follow. Precondition: less than 2^32.
  void PutCount(std::size_t count) { Put(static_cast<std::uint32_t>(count)); }

  /// Cut where its length would not fit into 32 bits.
  void PutText(std::string_view text) {
    text = text.substr(0, std::numeric_limits<std::uint32_t>::max() - 1);
    PutCount(text.size() + 1);
    const auto* const begin = reinterpret_cast<const std::byte*>(text.data());
    octets_.insert(octets_.end(), begin, begin + text.size());
    octets_.push_back(std::byte{0});
  }

  /// `count` numbers of `size` bytes, which lie one behind the other. Nothing, not even padding, for none.
  void PutPlain(const void* first, std::size_t size, std::size_t count) {
    if (count == 0) return;
    const std::size_t place = kHeader + (octets_.size() - kHeader + size - 1) / size * size;
    octets_.resize(place + size * count);
    std::memcpy(octets_.data() + place, first, size * count);
  }

 private:
  std::vector<std::byte>& octets_;
};

}  // namespace runnel
