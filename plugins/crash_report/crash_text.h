#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace runnel::internal {

/// A line that is put together where nothing may be allocated: what finds no room is cut off.
///
/// Threads: a value. May be used by the handler of a signal.
class CrashText {
 public:
  CrashText& operator<<(std::string_view text) noexcept;
  CrashText& operator<<(std::uint64_t number) noexcept { return Add(number, 10); }
  CrashText& Hexadecimal(std::uint64_t number) noexcept { return (*this << "0x").Add(number, 16); }

  [[nodiscard]] std::string_view text() const noexcept { return {bytes_.data(), size_}; }
  /// Writes it to a file descriptor; negative: nowhere.
  void WriteTo(int file) const noexcept;

 private:
  CrashText& Add(std::uint64_t number, unsigned base) noexcept;

  std::array<char, 1024> bytes_{};
  std::size_t size_ = 0;
};

/// "SIGSEGV", of those that a program crashes by.
[[nodiscard]] const char* SignalName(int signal) noexcept;

}  // namespace runnel::internal
