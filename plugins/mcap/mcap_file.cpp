#include "plugins/mcap/mcap_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/check.h"

namespace runnel {

Result<std::unique_ptr<McapFile>> McapFile::Open(const std::string& file) {
  const auto failure = [&](const std::string& why) {
    return Error{.message = "cannot be read: " + why, .position = {file}};
  };
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return failure(std::strerror(errno));
  struct stat state {};
  const int seen = fstat(descriptor, &state);
  const int number = errno;
  std::unique_ptr<McapFile> opened(
      new McapFile(file, descriptor, static_cast<std::uint64_t>(state.st_size)));
  if (seen != 0) return failure(std::strerror(number));
  if (!S_ISREG(state.st_mode)) return failure("it is no file");
  return opened;
}

McapFile::McapFile(std::string name, int descriptor, std::uint64_t size)
    : name_(std::move(name)), descriptor_(descriptor), size_(size) {}

McapFile::~McapFile() { close(descriptor_); }

Error McapFile::ErrorAt(std::uint64_t offset, const std::string& message) const {
  return {.message = "at byte " + std::to_string(offset) + ": " + message,
          .position = {name_}};
}

Result<void> McapFile::Read(std::uint64_t offset, std::uint64_t count, std::string& bytes) {
  if (offset > size_ || count > size_ - offset) {
    return ErrorAt(offset, "expected " + std::to_string(count) +
                               " bytes, but the file ends at byte " + std::to_string(size_));
  }
  bytes.resize(count);
  for (std::uint64_t done = 0; done < count;) {
    const ssize_t read =
        pread(descriptor_, bytes.data() + done, count - done, static_cast<off_t>(offset + done));
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) return ErrorAt(offset + done, std::strerror(errno));
    if (read == 0) return ErrorAt(offset + done, "the file has become shorter");
    done += static_cast<std::uint64_t>(read);
  }
  return {};
}

Result<std::string_view> McapFile::Look(std::uint64_t offset, std::uint64_t count) {
  RUNNEL_CHECK(count <= kWindow, "more is asked for than is read ahead");
  count = offset >= size_ ? 0 : std::min(count, size_ - offset);
  if (offset < window_offset_ || offset + count > window_offset_ + window_.size()) {
    const std::uint64_t ahead = offset >= size_ ? 0 : std::min(kWindow, size_ - offset);
    if (auto read = Read(offset, ahead, window_); !read) {
      window_.clear();
      return read.error();
    }
    window_offset_ = offset;
  }
  return std::string_view(window_).substr(offset - window_offset_, count);
}

}  // namespace runnel
