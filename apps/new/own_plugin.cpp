#include "apps/new/own_plugin.h"

#include <fstream>
#include <iterator>

#include "core/base/characters.h"
#include "core/base/replace_file.h"

namespace runnel::new_program {

namespace {

std::size_t BehindTheIncludes(const std::string& text) {
  const std::size_t last = text.rfind("\n#include ");
  const std::size_t from = last != std::string::npos ? last + 1 : 0;
  const bool has_any = last != std::string::npos || text.starts_with("#include ");
  const std::size_t end = text.find('\n', from);
  return has_any && end != std::string::npos ? end + 1 : 0;
}

}  // namespace

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
    return Error{.message = "no RUNNEL_PLUGIN(name, registry) { … } is in it",
                 .position = {plugin.file_.string()}};
  }
  const std::size_t name = begin + word.size();
  plugin.name_ = Trimmed(text.substr(name, comma - name));
  plugin.registry_ = Trimmed(text.substr(comma + 1, end - comma - 1));
  plugin.body_ = body + 1;
  plugin.includes_ = BehindTheIncludes(text);
  return plugin;
}

Result<void> OwnPlugin::Register(const std::string& header, const std::string& class_name,
                                 const std::string& type) {
  text_.insert(body_, "\n  " + registry_ + ".Add<" + class_name + ">(\"" + type +
                          "\", \"follows its input, no faster than it may\");");
  text_.insert(includes_, "#include \"" + header + "\"\n");
  return ReplaceFile(file_, text_);
}

}  // namespace runnel::new_program
