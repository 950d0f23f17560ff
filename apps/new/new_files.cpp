#include "apps/new/new_files.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/base/characters.h"
#include "core/base/files.h"

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

std::size_t BehindTheIncludes(const std::string& text) {
  const std::size_t last = text.rfind("\n#include ");
  const std::size_t from = last != std::string::npos ? last + 1 : 0;
  const bool has_any = last != std::string::npos || text.starts_with("#include ");
  const std::size_t end = text.find('\n', from);
  return has_any && end != std::string::npos ? end + 1 : 0;
}

}  // namespace

std::string Filled(std::string text, const Marks& marks) {
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

Result<OwnPlugin> OwnPlugin::Find(const std::filesystem::path& folder) {
  OwnPlugin plugin;
  plugin.file_ = folder / "plugin.cpp";
  std::ifstream stream(plugin.file_, std::ios::binary);
  if (!stream) {
    return Error{.message = "there is no plugin in this folder, to which it could be added",
                 .position = {plugin.file_.string()},
                 .hint = "go to the folder of one, or make one by 'runnel new plugin NAME'"};
  }
  std::string& text = plugin.text_;
  text.assign(std::istreambuf_iterator<char>(stream), {});
  const std::string word = "RUNNEL_PLUGIN(";
  const std::size_t begin = text.find(word);
  const std::size_t comma = text.find(',', begin);
  const std::size_t end = text.find(')', comma);
  const std::size_t body = text.find('{', end);
  if (begin == std::string::npos || body == std::string::npos) {
    return Error{.message = "no RUNNEL_PLUGIN(name, registry) { … } is in it", .position = {plugin.file_.string()}};
  }
  const std::size_t name = begin + word.size();
  plugin.name_ = Trimmed(text.substr(name, comma - name));
  plugin.registry_ = Trimmed(text.substr(comma + 1, end - comma - 1));
  plugin.body_ = body + 1;
  plugin.includes_ = BehindTheIncludes(text);
  return plugin;
}

Result<void> OwnPlugin::Register(const std::string& header, const std::string& class_name, const std::string& type) {
  text_.insert(body_, "\n  " + registry_ + ".Add<" + class_name + ">(\"" + type +
                          "\", \"follows its input, no faster than it may\");");
  text_.insert(includes_, "#include \"" + header + "\"\n");
  return ReplaceFile(file_, text_);
}

}  // namespace runnel::new_program
