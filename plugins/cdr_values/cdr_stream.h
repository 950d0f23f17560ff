#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/result.h"

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

/// Takes plain CDR (XCDR1) apart, of either order of octets, whatever somebody may have sent: nothing is read from
/// beyond the end, and each length is read once and held against what is left, so that the octets may even change
/// meanwhile.
///
/// Ownership:   looks at octets of the caller's; of a share in what keeps them, if lists may refer to them.
/// Allocation:  GetText() as far as the text has to grow, by no more octets than there are.
class CdrReader {
 public:
  /// `holder`: whoever has it keeps the octets as they are, so that values may refer to them; nullptr: they go.
  /// Errors: the octets have no encapsulation header, or that of something else than plain CDR.
  static Result<CdrReader> Begin(std::span<const std::byte> octets, std::shared_ptr<const void> holder = {});

  /// False if there is nothing left to get; what it was to be put into may then be half set.
  template <typename T>
  requires std::is_arithmetic_v<T>
  [[nodiscard]] bool Get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {  // of which C++ knows two values only
      std::uint8_t octet = 0;
      const bool is_there = Get(octet);
      value = octet != 0;
      return is_there;
    } else {
      return GetPlain(&value, sizeof value, 1);
    }
  }
  [[nodiscard]] bool GetText(std::string& text);
  /// The count of a list, if as many elements of at least `least` octets each can follow.
  [[nodiscard]] std::optional<std::size_t> GetCount(std::size_t least);
  /// `count` numbers of `size` bytes, one behind the other.
  [[nodiscard]] bool GetPlain(void* first, std::size_t size, std::size_t count);
  /// Where `count` numbers of `size` bytes lie for as long as anybody has holder(), in this machine's order of octets, and
  /// the reader then is behind them; nullptr, and it is where it was, if they go, are of the other order, or not there.
  [[nodiscard]] const std::byte* FindKept(std::size_t size, std::size_t count);
  [[nodiscard]] const std::shared_ptr<const void>& holder() const noexcept { return holder_; }
  /// Passes over `count` numbers of `size` bytes.
  [[nodiscard]] bool Skip(std::size_t size, std::size_t count) { return count == 0 || Take(size, count) != nullptr; }

  [[nodiscard]] std::size_t left() const noexcept { return octets_.size() - place_; }

 private:
  explicit CdrReader(std::span<const std::byte> octets, bool is_swapped, std::shared_ptr<const void> holder)
      : octets_(octets), holder_(std::move(holder)), is_swapped_(is_swapped) {}

  // Where `count` numbers begin, behind which the reader then is; nullptr if they are not there.
  const std::byte* Take(std::size_t size, std::size_t count);

  std::span<const std::byte> octets_;  // without the header
  std::shared_ptr<const void> holder_;
  std::size_t place_ = 0;
  bool is_swapped_;
};

}  // namespace runnel
