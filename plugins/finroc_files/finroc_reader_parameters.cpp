// Values of parameters, in each of the forms in which FINROC has written them.

#include <utility>

#include "core/base/nearest_name.h"
#include "core/types/type_info.h"
#include "plugins/finroc_files/finroc_names.h"
#include "plugins/finroc_files/finroc_reader.h"
#include "plugins/parameters/file_path.h"

namespace runnel::internal {

namespace {

namespace fs = std::filesystem;

const std::string& ParameterName(const ConfigurableElement& each) { return each.element->name(); }

// As everywhere, names of files start in the folder of the file that they stand in.
std::string TextFor(const Configurable& configurable, const std::string& text, const fs::path& folder) {
  return &configurable.type() == &TypeOf<FilePath>() ? ResolvedAgainst(folder, {text}).text : text;
}

}  // namespace

void FinrocReader::ReadStaticParameters(XmlElement element, FrameworkElement& module) {
  const std::vector<ConfigurableElement> all = ConfigurablesOf(module);
  for (const XmlElement list : element.children()) {
    if (list.name() == "element" || list.name() == "constructor") {
      Warn("<" + list.name() + "> in a module has no counterpart", "", list.position(), module);
    }
    if (list.name() != "parameters") continue;
    for (const XmlElement each : list.children()) {
      const std::string name = RunnelName(each.TextOr("name"));
      const ConfigurableElement parameter = FindConfigurable(module, name);
      const auto set = parameter ? parameter.configurable->SetFromText(
                                       TextFor(*parameter.configurable, each.text(), open_.back().parent_path()))
                                 : Result<void>(Error{.message = "there is no parameter '" + name + "'",
                                                      .hint = NearestNameHint(name, NamesOf(all, ParameterName))});
      if (!set) Warn(set.error().message, set.error().hint, each.position(), module);
    }
  }
}

// As newer versions write them: nested like the elements, without the group "Parameters".
void FinrocReader::ReadParameterLinks(XmlElement links, const std::string& path, FrameworkElement& group) {
  for (const XmlElement child : links.children()) {
    const std::string name = RunnelName(child.TextOr("name"));
    if (child.name() == "element") {
      ReadParameterLinks(child, path.empty() ? name : path + "/" + name, group);
    } else if (child.name() == "parameter") {
      ReadParameter(child, path, name, group);
    } else {
      Warn("<" + child.name() + "> has no counterpart", "", child.position(), group);
    }
  }
}

void FinrocReader::ReadParameter(XmlElement parameter, const std::string& path, const std::string& name,
                                 FrameworkElement& group) {
  const auto module = group.Find(path);
  const std::vector<ConfigurableElement> all = module ? ConfigurablesOf(**module) : std::vector<ConfigurableElement>();
  const ConfigurableElement found = module ? FindConfigurable(**module, name) : ConfigurableElement();
  const auto from_file = [&](const std::string& text, const fs::path& file) {
    return found ? TextFor(*found.configurable, text, file.parent_path()) : text;
  };
  std::vector<std::pair<std::string, SourcePosition>> candidates;
  if (const XmlAttribute* value = parameter.Attribute("default")) {
    candidates.emplace_back(from_file(value->value, open_.back()), value->value_position);
  }
  if (const auto* entry = context_.configuration().FindEntry(parameter.TextOr("config"))) {
    candidates.emplace_back(from_file(entry->text, entry->position.file), entry->position);
  }
  if (const auto* entry = context_.configuration().FindArgument(parameter.TextOr("cmdline"))) {
    candidates.emplace_back(entry->text, entry->position);
  }
  if (!found) {
    return Warn("there is no parameter '" + (path.empty() ? name : path + "/" + name) + "'",
                NearestNameHint(name, NamesOf(all, ParameterName)), parameter.position(), group);
  }
  if (candidates.empty()) return;
  const auto& [text, position] = candidates.back();
  if (auto set = found.configurable->SetFromText(text); !set) {
    Error error = set.error();
    error.position = position;
    context_.Report(std::move(error), position, *found.element);
  }
}

}  // namespace runnel::internal
