#include "plugins/application/internal/stop_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/base/files.h"
#include "plugins/control/control_folder.h"

namespace runnel {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestBy = 200;
constexpr const char* kElsewhere = ", in another process that runs";
constexpr const char* kBefore = ", in a process before this one";

// FNV-1a: the same in each process and version.
std::uint64_t HashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3U;
  return hash;
}

Error LastError(const fs::path& file) { return {.message = std::strerror(errno), .position = {file.string()}}; }

// Right after it was opened: what is there and cannot be opened may be held.
bool IsHeld(const FileDescriptor& file) {
  return file.is_open() ? flock(file.number(), LOCK_EX | LOCK_NB) != 0 : errno != ENOENT;
}

FileDescriptor Open(const fs::path& file, int how = O_RDONLY) {
  return FileDescriptor(open(file.c_str(), how | O_NOFOLLOW | O_CLOEXEC, 0600));
}

// Who pressed STOP there, however many processes ago.
std::string PressedBy(const fs::path& file) {
  std::string by;
  std::ifstream stream(file);
  std::getline(stream, by);
  by = by.substr(0, std::min({by.find(kElsewhere), by.find(kBefore), kLongestBy}));
  return (by.empty() ? "somebody" : by) + (IsHeld(Open(file)) ? kElsewhere : kBefore);
}

// `name`: how the names of all files of one application begin.
std::vector<fs::path> FilesOf(const fs::path& folder, const std::string& name) {
  std::vector<fs::path> files;
  for (const std::string& each : NamesInFolder(folder)) {
    if (each.starts_with(name)) files.push_back(folder / each);
  }
  return files;
}

// Of these, what nobody holds.
Result<void> RemoveLeft(const std::vector<fs::path>& files) {
  Result<void> done;
  for (const fs::path& each : files) {
    const FileDescriptor file = Open(each);
    if (!IsHeld(file) && unlink(each.c_str()) != 0 && errno != ENOENT) done = LastError(each);
  }
  return done;
}

// What cannot be listed is as if there were nothing in it.
Result<void> CheckFolder(const fs::path& folder) {
  if (auto trusted = CheckControlFolder(folder); !trusted) return trusted;
  std::error_code ignored;
  if (fs::exists(folder, ignored) && access(folder.c_str(), R_OK | X_OK) != 0) return LastError(folder);
  return {};
}

std::string OwnName() {
  static std::atomic<int> number{0};
  return fmt::format("{}-{}.stop", getpid(), ++number);
}

}  // namespace

Result<std::unique_ptr<StopFile>> StopFile::Follow(RobotStop& stop, ApplicationLog& log,
                                                   const fs::path& application_file, const std::string& name,
                                                   bool clears, Diagnostics& diagnostics) {
  const fs::path folder = ControlFolder();
  if (auto trusted = CheckFolder(folder); !trusted) {
    Error error = trusted.error().WithContext("whether a STOP is in force cannot be known");
    if (!clears) return error;
    diagnostics.AddWarning(std::move(error));
    return std::unique_ptr<StopFile>();
  }
  std::error_code failure;
  if (!fs::exists(folder, failure) && access(folder.parent_path().c_str(), W_OK | X_OK) != 0) {
    diagnostics.AddWarning(SystemError("a STOP will end with this process", folder.string()));
    return std::unique_ptr<StopFile>();
  }
  const std::string identity = fs::weakly_canonical(application_file, failure).string() + "\n" + name;
  const std::string file_name = fmt::format("{:016x}-", HashOf(identity));
  if (clears) {
    if (auto removed = RemoveLeft(FilesOf(folder, file_name)); !removed) {
      return removed.error().WithContext("the STOP cannot be cleared");
    }
  }
  const auto left = clears ? std::vector<fs::path>() : FilesOf(folder, file_name);
  const std::string by = left.empty() ? "" : PressedBy(left.front());
  auto follows = std::make_unique<StopFile>(stop, log, folder, file_name, left);
  if (left.empty()) return follows;
  stop.Press(by);
  diagnostics.AddWarning({.message = "the application begins under STOP, pressed by " + stop.state().by,
                          .hint = "'runnel release' ends it; 'runnel run --clear-stop' begins without"});
  return follows;
}

StopFile::StopFile(RobotStop& stop, ApplicationLog& log, fs::path folder, const std::string& name,
                   std::vector<fs::path> left)
    : stop_(stop),
      log_(log),
      folder_(std::move(folder)),
      file_(folder_ / (name + OwnName())),
      left_(std::move(left)),
      lookout_(std::in_place,
               [this]() -> std::optional<Time> {
                 Write();
                 return {};
               }),
      changes_(stop.signal()->Listen([this] { lookout_->Ask(); })) {
  lookout_->Ask();  // it may have been pressed while the application was loaded
}

StopFile::~StopFile() {
  changes_ = {};
  lookout_.reset();
}

bool StopFile::IsKept() {
  constexpr auto kPatience = std::chrono::milliseconds(50);
  const std::uint64_t last = stop_.state().changes;
  std::unique_lock lock(mutex_);
  return has_written_.wait_for(lock, kPatience, [&] { return written_ >= last; }) && !has_failed_;
}

// The last one finds the last state.
void StopFile::Write() noexcept {
  try {
    const auto state = stop_.state();
    const auto done = state.changes == 0 ? Result<void>() : Follow(state);
    if (!done) {
      log_.Add(ApplicationLog::Kind::kWarning,
               done.error()
                   .WithContext(state.in_force ? "STOP will end with this process"
                                               : "the next process will begin under STOP")
                   .ToString());
    }
    const std::lock_guard lock(mutex_);
    written_ = state.changes;
    has_failed_ = !done;
  } catch (...) {
    // Out of memory: STOP is in force without the file, which is what matters now.
  }
  has_written_.notify_all();
}

Result<void> StopFile::Follow(const RobotStop::State& state) {
  if (state.in_force && !held_.is_open()) {
    if (auto made = MakeControlFolder(folder_); !made) return made;
    if (auto held = Hold(state.by + "\n"); !held) return held;
  } else if (!state.in_force && held_.is_open()) {
    if (unlink(file_.c_str()) != 0 && errno != ENOENT) return LastError(file_);
    held_ = FileDescriptor();
  }
  auto removed = RemoveLeft(left_);
  if (removed) left_.clear();  // what is left from now on was not taken over here
  return removed;
}

// It gets its name when it is held and says who pressed: whoever looks meanwhile finds nothing, or all of it.
Result<void> StopFile::Hold(const std::string& text) {
  const fs::path unnamed = folder_ / ("." + file_.filename().string());
  FileDescriptor file = Open(unnamed, O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open() || flock(file.number(), LOCK_EX) != 0 ||
      write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
      rename(unnamed.c_str(), file_.c_str()) != 0) {
    return LastError(file_);
  }
  held_ = std::move(file);
  return {};
}

}  // namespace runnel
