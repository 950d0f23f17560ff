#include "apps/new/new_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "apps/new/templates.h"

namespace runnel::new_program {

namespace {

namespace fs = std::filesystem;

/// What has been made on the way, and goes again if not everything could be.
class Made {
 public:
  ~Made() {
    std::error_code ignored;
    for (auto each = made_.rbegin(); each != made_.rend(); ++each) fs::remove(*each, ignored);
  }
  void Keep() { made_.clear(); }

  Result<void> Folder(const fs::path& folder) {
    if (folder.empty() || fs::exists(folder)) return {};
    if (auto parent = Folder(folder.parent_path()); !parent) return parent;
    std::error_code error;
    if (fs::create_directory(folder, error)) made_.push_back(folder);
    if (error) return Error{.message = error.message(), .position = {folder.string()}};
    return {};
  }
  Result<void> File(const NewFile& file) {
    // Only if there is none, whoever else is just making one.
    std::FILE* const stream = std::fopen(file.path.c_str(), "wx");
    if (stream == nullptr) {
      return Error{.message = std::strerror(errno), .position = {file.path.string()}};
    }
    made_.push_back(file.path);
    const bool is_written = std::fputs(file.text.c_str(), stream) >= 0;
    if (std::fclose(stream) != 0 || !is_written) {
      return Error{.message = "cannot be written", .position = {file.path.string()}};
    }
    return {};
  }

 private:
  std::vector<fs::path> made_;
};

}  // namespace

std::string FilledTemplate(const std::string& name,
                           const std::map<std::string, std::string>& marks) {
  std::string text = Templates().at(name);
  for (const auto& [mark, meaning] : marks) {
    const std::string written = "@" + mark + "@";
    for (std::size_t at = 0; (at = text.find(written, at)) != std::string::npos;) {
      text.replace(at, written.size(), meaning);
      at += meaning.size();
    }
  }
  return text;
}

Result<void> WriteAll(const std::vector<NewFile>& files) {
  for (const NewFile& file : files) {
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file.path, ignored))) continue;
    return Error{.message = "this is there already, and nothing is overwritten",
                 .position = {file.path.string()},
                 .hint = "take another name, or another folder"};
  }
  Made made;
  for (const NewFile& file : files) {
    if (auto folder = made.Folder(file.path.parent_path()); !folder) return folder;
    if (auto written = made.File(file); !written) return written;
  }
  made.Keep();
  return {};
}

}  // namespace runnel::new_program
