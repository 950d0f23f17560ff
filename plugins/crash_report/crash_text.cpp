#include "plugins/crash_report/crash_text.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <unistd.h>

namespace runnel::internal {

CrashText& CrashText::operator<<(std::string_view text) noexcept {
  const std::size_t count = std::min(text.size(), bytes_.size() - size_);
  std::memcpy(bytes_.data() + size_, text.data(), count);
  size_ += count;
  return *this;
}

CrashText& CrashText::Add(std::uint64_t number, unsigned base) noexcept {
  std::array<char, 20> digits{};
  std::size_t first = digits.size();
  do {
    digits[--first] = "0123456789abcdef"[number % base];
    number /= base;
  } while (number > 0);
  return *this << std::string_view(digits.data() + first, digits.size() - first);
}

void CrashText::WriteTo(int file) const noexcept {
  if (file < 0) return;
  for (std::string_view left = text(); !left.empty();) {
    const ssize_t count = write(file, left.data(), left.size());
    if (count < 0 && errno != EINTR) return;
    left.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
  }
}

const char* SignalName(int signal) noexcept {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    case SIGABRT:
      return "SIGABRT";
    default:
      return "a signal";
  }
}

}  // namespace runnel::internal
