#include "core/base/files.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/file_descriptor.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr mode_t kPermissionBits = 07777;
constexpr const char* kSuffix = ".new";

Error Failure(const fs::path& file, const std::string& what, int number) {
  return {.message = what + ": " + std::strerror(number), .position = {file.string()}};
}

/// The new file, until it has taken the name of the old.
class NewFile {
 public:
  NewFile(fs::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  ~NewFile() {
    if (is_there_) unlink(path_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  // 0, or what went wrong.
  int Write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = write(descriptor_.number(), text.data(), text.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
  }
  int SetMode(mode_t mode) { return fchmod(descriptor_.number(), mode) == 0 ? 0 : errno; }
  int BringToDisk() { return fsync(descriptor_.number()) == 0 ? 0 : errno; }
  int TakeNameOf(const fs::path& file) {
    if (rename(path_.c_str(), file.c_str()) != 0) return errno;
    is_there_ = false;
    return 0;
  }

 private:
  fs::path path_;
  FileDescriptor descriptor_;
  bool is_there_ = true;
};

std::string Prefix(const fs::path& file) { return "." + file.filename().string() + "."; }

fs::path NewName(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  return file.parent_path() /
         (Prefix(file) + std::to_string(getpid()) + "-" + std::to_string(count.fetch_add(1)) + kSuffix);
}

// What a program that was killed in between has left behind.
void RemoveRemains(const fs::path& file) {
  const std::string prefix = Prefix(file);
  const fs::path folder = file.parent_path();
  for (const std::string& name : NamesInFolder(folder)) {
    if (!name.starts_with(prefix) || !name.ends_with(kSuffix)) continue;
    pid_t process = 0;
    const char* const begin = name.data() + prefix.size();
    const auto [stop, error] = std::from_chars(begin, name.data() + name.size(), process);
    if (error != std::errc() || process <= 0 || *stop != '-') continue;
    if (kill(process, 0) != 0 && errno == ESRCH) unlink((folder / name).c_str());
  }
}

// The new name is on the disk only when the folder is.
int BringFolderToDisk(const fs::path& folder) {
  const FileDescriptor descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!descriptor.is_open()) return errno;
  if (fsync(descriptor.number()) == 0 || errno == EINVAL) return 0;  // some file systems have no such
  return errno;
}

Result<fs::path> RealFile(const fs::path& file) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(fs::absolute(file, error), error);
  if (error) return Failure(file, "the folder cannot be reached", error.value());
  if (!fs::is_directory(real.parent_path(), error)) {
    return Error{.message = "there is no folder " + real.parent_path().string(), .position = {file.string()}};
  }
  if (fs::exists(real, error) && !fs::is_regular_file(real, error)) {
    return Error{.message = "is not a file that could be replaced", .position = {file.string()}};
  }
  return real;
}

}  // namespace

Result<void> ReplaceFile(const fs::path& file, std::string_view text) {
  const auto real = RealFile(file);
  if (!real) return real.error();
  struct stat known {};
  const bool replaces = stat(real->c_str(), &known) == 0;
  if (replaces && access(real->c_str(), W_OK) != 0) {
    return Failure(file, "must not be written", errno);
  }
  RemoveRemains(*real);
  const fs::path folder = real->parent_path();
  fs::path name = NewName(*real);
  constexpr mode_t kForAll = 0666;  // less what the user's mask takes away
  const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kForAll);
  if (descriptor < 0) return Failure(file, "no file can be made in its folder", errno);
  NewFile made(std::move(name), descriptor);
  int problem = made.Write(text);
  if (problem == 0 && replaces) problem = made.SetMode(known.st_mode & kPermissionBits);
  if (problem == 0) problem = made.BringToDisk();
  if (problem == 0) problem = made.TakeNameOf(*real);
  if (problem != 0) return Failure(file, "cannot be written", problem);
  problem = BringFolderToDisk(folder);
  if (problem != 0) return Failure(file, "has been written, but may not survive a crash", problem);
  return {};
}

Result<void> KeepBackup(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return {};
  const fs::path real = fs::canonical(file, error);
  const fs::path backup = real.string() + "~";
  // A link of that name would be followed otherwise.
  if (!error) fs::remove(backup, error);
  if (!error) fs::copy_file(real, backup, error);
  if (!error) return {};
  return Error{.message = "what is in it cannot be kept as " + backup.filename().string() + ": " + error.message(),
               .position = {file.string()}};
}

// Not by std::filesystem::directory_iterator, which ends the process in GCC 12 when there is no memory for
// a path, and which throws at an entry that cannot be read.
std::vector<std::string> NamesInFolder(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  const std::unique_ptr<DIR, int (*)(DIR*)> listing(opendir(folder.empty() ? "." : folder.c_str()), closedir);
  if (!listing) return names;
  while (const dirent* const entry = readdir(listing.get())) {
    std::string name = entry->d_name;
    if (name != "." && name != "..") names.push_back(std::move(name));
  }
  std::ranges::sort(names);  // the order of a directory is nobody's
  return names;
}

std::optional<std::string> TextOfFile(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

namespace {
constexpr int kOpenFolders = 16;
}

Result<TemporaryFolder> TemporaryFolder::Make(std::string_view purpose) {
  const auto failed = [](const std::error_code& why) {
    return Error{.message = "cannot make a temporary folder: " + why.message(),
                 .hint = "TMPDIR names the folder for temporary files"};
  };
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  if (error) return failed(error);
  std::string folder = (temporary / "runnel-").string().append(purpose).append("-XXXXXX");
  if (mkdtemp(folder.data()) == nullptr) return failed({errno, std::generic_category()});
  return TemporaryFolder(folder);
}

// By the C library: the iterators that the C++ library removes by end the process where there is no memory.
TemporaryFolder::~TemporaryFolder() {
  if (path_.empty()) return;
  const auto remove_one = [](const char* path, const struct stat*, int, FTW*) {
    (void)std::remove(path);  // what stays harms nobody
    return 0;
  };
  (void)nftw(path_.c_str(), remove_one, kOpenFolders, FTW_DEPTH | FTW_PHYS);
}

Result<TemporaryCopy> TemporaryCopy::Make(const fs::path& file) {
  const auto failed = [&](const std::string& why) {
    return Error{.message = "cannot copy " + file.string() + ": " + why,
                 .hint = "TMPDIR names the folder for the copy"};
  };
  Result<TemporaryFolder> folder = TemporaryFolder::Make("copy");
  if (!folder) return failed(folder.error().message);
  const fs::path copy = folder->path() / file.filename();
  std::error_code error;
  fs::copy_file(file, copy, error);
  if (error) return failed(error.message());
  return TemporaryCopy(*std::move(folder), copy);
}

}  // namespace runnel
