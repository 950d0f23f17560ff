#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace runnel {

/// Who has called whom, innermost first, as addresses to which calls return.
///
/// Threads: a value. Allocation: none, but for Texts().
class CallStack {
 public:
  /// Taking the first one of a process may allocate: take one before it matters.
  [[nodiscard]] static CallStack Take() noexcept;

  /// Keeps what is between two functions that wanted to be there: the inner was called from `inner`, the outer returns
  /// to `outer`; neither is kept. What is not in the stack cuts nothing off.
  void KeepBetween(const void* inner, const void* outer) noexcept;
  [[nodiscard]] std::span<void* const> frames() const noexcept { return {frames_.data(), depth_}; }
  friend bool operator==(const CallStack& a, const CallStack& b) noexcept;

  /// One line for each call, innermost first, inlined ones too: "Wanderer::Update() at wanderer.cpp:26". Asks the program addr2line of
  /// the package binutils, if it is there; without, functions that no library exports have no names, and
  /// nothing a line.
  [[nodiscard]] std::vector<std::string> Texts() const;

 private:
  static constexpr std::size_t kDeepest = 40;
  std::array<void*, kDeepest> frames_{};
  std::size_t depth_ = 0;
};

/// As people write it: "runnel::Laser" of "N6runnel5LaserE"; what is no such name stays as it is.
[[nodiscard]] std::string Demangled(const char* name);

}  // namespace runnel
