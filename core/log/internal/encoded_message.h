#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/log/log_level.h"

namespace runnel {

class Logger;

namespace internal {

/// What a message can speak of: numbers, truth values, characters and texts. They travel as they are, and are
/// formatted where there is time for it.
template <typename T>
concept IsLoggable = std::integral<T> || std::same_as<T, float> || std::same_as<T, double> ||
    std::convertible_to<const T&, std::string_view>;

/// A message on its way from the cycle that says it to who formats it: the format and the arguments as bytes, so
/// that nothing of it lies in a library that may have been unloaded meanwhile.
///
/// Threads: one. Allocation: none.
class EncodedMessage {
 public:
  static constexpr std::size_t kMostBytes = 512;
  /// Of the format alone; a longer one is cut off, and stands there as it is written.
  static constexpr std::size_t kLongestFormat = 300;

  struct Header {
    const Logger* source = nullptr;
    std::int64_t time = 0;  ///< ns
    std::uint64_t left_out = 0;
    std::uint16_t size = sizeof(Header);  ///< of all of it
    std::uint16_t format_size = 0;
    LogLevel level = LogLevel::kInfo;
    bool is_cut = false;  ///< the format, or an argument for which there was no room
  };
  enum class Kind : std::uint8_t { kBool, kCharacter, kSigned, kUnsigned, kFloat, kDouble, kText };

  explicit EncodedMessage(std::string_view format) noexcept {
    header_.is_cut = format.size() > kLongestFormat;
    header_.format_size = static_cast<std::uint16_t>(std::min(format.size(), kLongestFormat));
    Append(format.data(), header_.format_size);
  }

  template <IsLoggable T>
  void Add(const T& argument) noexcept {
    if constexpr (std::same_as<T, bool>) {
      AddPlain(Kind::kBool, argument);
    } else if constexpr (std::same_as<T, char>) {
      AddPlain(Kind::kCharacter, argument);
    } else if constexpr (std::signed_integral<T>) {
      AddPlain(Kind::kSigned, static_cast<std::int64_t>(argument));
    } else if constexpr (std::unsigned_integral<T>) {
      AddPlain(Kind::kUnsigned, static_cast<std::uint64_t>(argument));
    } else if constexpr (std::same_as<T, float>) {
      AddPlain(Kind::kFloat, argument);
    } else if constexpr (std::same_as<T, double>) {
      AddPlain(Kind::kDouble, argument);
    } else {
      AddText(argument);
    }
  }

  [[nodiscard]] Header& header() noexcept { return header_; }
  /// All of it, the header first.
  [[nodiscard]] const std::byte* Finish() noexcept {
    std::memcpy(bytes_.data(), &header_, sizeof header_);
    return bytes_.data();
  }
  [[nodiscard]] std::size_t size() const noexcept { return header_.size; }

  /// The text of a finished message, whose `header` has been taken off. Allocates. A format that does not fit
  /// its arguments stands there as it is written.
  [[nodiscard]] static std::string TextOf(const Header& header, const std::byte* after_header);

 private:
  template <typename T>
  void AddPlain(Kind kind, T value) noexcept {
    if (header_.is_cut || !HasRoomFor(1 + sizeof value)) return Cut();
    Append(&kind, 1);
    Append(&value, sizeof value);
  }
  void AddText(std::string_view text) noexcept {
    if (header_.is_cut || !HasRoomFor(1 + sizeof(std::uint16_t))) return Cut();
    const Kind kind = Kind::kText;
    const std::size_t room = kMostBytes - header_.size - 1 - sizeof(std::uint16_t);
    const auto size = static_cast<std::uint16_t>(std::min(text.size(), room));
    Append(&kind, 1);
    Append(&size, sizeof size);
    Append(text.data(), size);
  }
  [[nodiscard]] bool HasRoomFor(std::size_t size) const noexcept { return header_.size + size <= kMostBytes; }
  void Cut() noexcept { header_.is_cut = true; }
  void Append(const void* from, std::size_t size) noexcept {
    std::memcpy(bytes_.data() + header_.size, from, size);
    header_.size = static_cast<std::uint16_t>(header_.size + size);
  }

  Header header_;
  std::array<std::byte, kMostBytes> bytes_;
};

static_assert(std::is_trivially_copyable_v<EncodedMessage::Header>);

}  // namespace internal
}  // namespace runnel
