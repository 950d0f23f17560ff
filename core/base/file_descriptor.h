#pragma once

#include <cerrno>
#include <utility>

#include <unistd.h>

namespace runnel {

/// What the system has opened for its owner, a file or a socket: closed with it. Threads: as an int; moving is its owner's.
class FileDescriptor {
 public:
  /// -1: none.
  explicit FileDescriptor(int number = -1) noexcept : number_(number) {}
  FileDescriptor(FileDescriptor&& from) noexcept : number_(std::exchange(from.number_, -1)) {}
  /// What it was before goes with `from`.
  FileDescriptor& operator=(FileDescriptor&& from) noexcept {
    std::swap(number_, from.number_);
    return *this;
  }
  /// Leaves errno as it is, for what is said of a failure.
  ~FileDescriptor() {
    const int before = errno;
    if (is_open()) close(number_);
    errno = before;
  }

  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }

 private:
  int number_;
};

}  // namespace runnel
