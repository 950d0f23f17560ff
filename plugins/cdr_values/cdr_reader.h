#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace runnel {

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
