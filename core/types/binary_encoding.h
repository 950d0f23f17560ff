#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace runnel {

class TypeInfo;

/// Appends bytes, numbers in little-endian order.
class BinaryWriter {
 public:
  explicit BinaryWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

  void WriteBytes(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  template <std::unsigned_integral U>
  void WriteUnsigned(U number) {
    for (std::size_t i = 0; i < sizeof(U); ++i) {
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(number) >> (8 * i)));
    }
  }

 private:
  std::vector<std::byte>& bytes_;
};

/// Takes bytes from the front. False where there are not enough left; nothing is taken then.
class BinaryReader {
 public:
  explicit BinaryReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t remaining() const noexcept { return bytes_.size(); }
  bool ReadBytes(std::span<std::byte> target) {
    if (target.size() > bytes_.size()) return false;
    if (!target.empty()) std::memcpy(target.data(), bytes_.data(), target.size());
    bytes_ = bytes_.subspan(target.size());
    return true;
  }
  template <std::unsigned_integral U>
  bool ReadUnsigned(U& number) {
    if (sizeof(U) > bytes_.size()) return false;
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < sizeof(U); ++i) {
      all |= static_cast<std::uint64_t>(bytes_[i]) << (8 * i);
    }
    number = static_cast<U>(all);
    bytes_ = bytes_.subspan(sizeof(U));
    return true;
  }

 private:
  std::span<const std::byte> bytes_;
};

/// Values as bytes, for recording and sending: numbers at their size, little-endian; bool one byte;
/// strings, sequences of any length and matrices of any size with their counts (32 bits) before;
/// enumerations as 64 bit numbers, of which only named ones are read; structures field by field. No names, no padding: who reads must
/// know the type.
///
/// `value` points to an object of the type. Threads: as for that object.

/// Appends to `bytes`. Allocates only if they have no room. Errors: something in the type is
/// opaque.
Result<void> ToBinary(const TypeInfo& type, const void* value, std::vector<std::byte>& bytes);

/// Takes one value off `reader`. Never reads past its end, and makes no room for more elements than
/// there are bytes, nor for more than 256 MiB of them. Errors: too short, not what ToBinary() writes,
/// nested deeper than 100 levels; the value may then be half set.
Result<void> FromBinary(const TypeInfo& type, BinaryReader& reader, void* value);

}  // namespace runnel
