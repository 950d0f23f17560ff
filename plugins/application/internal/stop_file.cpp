#include "plugins/application/internal/stop_file.h"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "plugins/control/control_folder.h"

namespace runnel {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestBy = 200;

// FNV-1a: the same in each process and version.
std::uint64_t HashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
  return hash;
}

Error Telling(const std::string& what, Error error) {
  error.message = what + ": " + error.message;
  return error;
}

// Who pressed STOP; nothing if it was not in force. What cannot be looked at counts as a STOP.
std::optional<std::string> LeftBy(const fs::path& file) {
  std::error_code failure;
  if (fs::symlink_status(file, failure).type() == fs::file_type::not_found) return {};
  std::string by;
  std::ifstream stream(file);
  std::getline(stream, by);
  return by.empty() ? "somebody" : by.substr(0, kLongestBy);
}

Result<void> Write(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0600);
  const bool is_written = descriptor >= 0 && write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const int problem = errno;
  if (descriptor >= 0) close(descriptor);
  if (is_written) return {};
  return Error{.message = std::strerror(problem), .position = {file.string()}};
}

}  // namespace

Result<std::unique_ptr<StopFile>> StopFile::Follow(RobotStop& stop, ApplicationLog& log,
                                                   const fs::path& application_file,
                                                   const std::string& name, bool clears,
                                                   Diagnostics& diagnostics) {
  const fs::path folder = ControlFolder();
  if (auto trusted = CheckControlFolder(folder); !trusted) {
    Error error = Telling("whether a STOP is in force cannot be known", trusted.error());
    if (!clears) return error;
    diagnostics.AddWarning(std::move(error));
    return std::unique_ptr<StopFile>();
  }
  std::error_code failure;
  if (!fs::exists(folder, failure) && access(folder.parent_path().c_str(), W_OK | X_OK) != 0) {
    Error error{.message = std::strerror(errno), .position = {folder.string()}};
    diagnostics.AddWarning(Telling("a STOP will end with this process", std::move(error)));
    return std::unique_ptr<StopFile>();
  }
  const std::string identity = fs::absolute(application_file).lexically_normal().string() + "\n" + name;
  const fs::path file = folder / fmt::format("{:016x}.stop", HashOf(identity));
  const auto left_by = LeftBy(file);
  if (left_by && clears) {  // before anybody's press is written there
    fs::remove(file, failure);
    if (failure) return Error{.message = "the STOP cannot be cleared: " + failure.message(), .position = {file.string()}};
  }
  auto follows = std::make_unique<StopFile>(stop, log, file);
  if (left_by && !clears) {
    stop.Press(*left_by + ", in a process before this one");
    diagnostics.AddWarning({.message = "the application begins under STOP, pressed by " + stop.state().by,
                            .hint = "'runnel release' ends it; 'runnel run --clear-stop' begins without"});
  }
  return follows;
}

StopFile::StopFile(RobotStop& stop, ApplicationLog& log, fs::path file)
    : stop_(stop), log_(log), file_(std::move(file)), changes_(stop.signal()->Listen([this] { Note(); })) {
  if (stop_.in_force()) Note();  // pressed while the application was loaded
}

// One at a time, and the last one finds the last state.
void StopFile::Note() noexcept {
  try {
    const std::lock_guard lock(writing_);
    const auto state = stop_.state();
    Result<void> done;
    if (state.in_force) {
      done = MakeControlFolder(file_.parent_path());
      if (done) done = Write(file_, state.by + "\n");
    } else if (unlink(file_.c_str()) != 0 && errno != ENOENT) {
      done = Error{.message = std::strerror(errno), .position = {file_.string()}};
    }
    if (done) return;
    log_.Add(ApplicationLog::Kind::kWarning,
             Telling(state.in_force ? "STOP will end with this process" : "the next process will begin under STOP", done.error())
                 .ToString());
  } catch (...) {
    // Out of memory: STOP is in force without the file, which is what matters now.
  }
}

}  // namespace runnel
