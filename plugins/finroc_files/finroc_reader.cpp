#include "plugins/finroc_files/finroc_reader.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/conversion/conversion.h"
#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "core/paths/late_connections.h"
#include "core/port/proxy_port.h"
#include "core/types/duration_text.h"
#include "core/types/type_info.h"
#include "plugins/finroc_files/finroc_names.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::internal {

namespace {

namespace fs = std::filesystem;

// A file of ten groups of ten groups … is short, and would never come to an end.
constexpr std::size_t kMostFiles = 10'000;
constexpr auto kUsualPeriod = std::chrono::milliseconds(40);

// Of `<parameters><parameter name="XML file">…`; "" if it is not there.
std::string StaticParameter(XmlElement element, std::string_view name) {
  for (const XmlElement list : element.children()) {
    if (list.name() != "parameters") continue;
    for (const XmlElement each : list.children()) {
      if (RunnelName(each.TextOr("name")) == name) return each.text();
    }
  }
  return "";
}

// Whether a path is a URI, "tcp:host/path": names of elements may hold a ':' further on.
bool HasScheme(std::string_view path) {
  const auto is_of_scheme = [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9') || character == '+' ||
           character == '-' || character == '.';
  };
  const auto end = std::ranges::find_if_not(path, is_of_scheme);
  return end != path.begin() && end != path.end() && *end == ':';
}

}  // namespace

void FinrocReader::Warn(std::string message, std::string hint, const SourcePosition& position,
                        const FrameworkElement& element) {
  context_.Warn({.message = std::move(message), .hint = std::move(hint)}, position, element);
}

void FinrocReader::Read(XmlElement root, const fs::path& file) {
  ReadContents(root, application_, file);
  if (!has_thread_) AddThread("main", kUsualPeriod, application_);
}

void FinrocReader::AddThread(const std::string& name, Duration period, FrameworkElement& of) {
  FrameworkElement* threads = application_.FindChild("threads");
  if (threads == nullptr) threads = &context_.runtime().Create<Group>(application_, "threads");
  const ThreadOptions options{.period = period};
  AssignThread(of, context_.runtime().Create<ThreadContainer>(*threads, FreeName(*threads, name), options));
  has_thread_ = true;
}

void FinrocReader::ReadContents(XmlElement root, FrameworkElement& group, const fs::path& file) {
  open_.push_back(file);
  LoadLibraries(root);
  for (const XmlElement child : root.children()) {
    if (child.name() == "element") ReadElement(child, group, file);
  }
  for (const XmlElement child : root.children()) {
    if (child.name() == "interface") ReadInterface(child, group);
  }
  for (const XmlElement child : root.children()) {
    if (child.name() == "edge") {
      ReadEdge(child, group);
    } else if (child.name() == "parameter") {
      const std::string link = RunnelPath(child.TextOr("link"));
      ReadParameter(child, WithoutLast(link, 2), LastName(link), group);
    } else if (child.name() == "parameter_links") {
      ReadParameterLinks(child, "", group);
    } else if (child.name() != "element" && child.name() != "interface") {
      Warn("<" + child.name() + "> has no counterpart", "", child.position(), group);
    }
  }
  open_.pop_back();
}

void FinrocReader::LoadLibraries(XmlElement root) {
  const XmlAttribute* const dependencies = root.Attribute("dependencies");
  if (dependencies == nullptr) return;
  std::istringstream words(dependencies->value);
  for (std::string word; std::getline(words >> std::ws, word, ',');) {
    const std::string plugin = LibraryName(word);
    const bool is_ours = plugin == "structure" || plugin == "scheduling";
    if (is_ours || LoadLibrary(plugin)) continue;
    Warn("there is no plugin '" + plugin + "' for " + word, NearestNameHint(plugin, context_.plugins().Available()),
         dependencies->value_position, application_);
  }
}

bool FinrocReader::LoadLibrary(const std::string& plugin) {
  const auto is_of_plugin = [&](const ModuleType* type) { return type->name.starts_with(plugin + "/"); };
  if (std::ranges::any_of(context_.plugins().modules().All(), is_of_plugin)) return true;
  const std::vector<std::string> known = context_.plugins().Available();
  return std::ranges::count(known, plugin) > 0 && context_.plugins().Load(plugin);
}

void FinrocReader::ReadElement(XmlElement element, FrameworkElement& parent, const fs::path& file) {
  const std::string name = RunnelName(element.TextOr("name"));
  const std::string type = RunnelName(element.TextOr("type"));
  if (parent.FindChild(name) != nullptr) {
    return Warn("there is already an element called '" + name + "'",
                "names differ by more than blanks and capitals here", element.position(), parent);
  }
  const bool is_thread = type.ends_with("thread_container");
  const bool is_group = is_thread || type == "group" || type.ends_with("_group");
  const bool is_of_structure = LibraryName(element.TextOr("group")) == "structure";
  if (!is_of_structure || !is_group) return ReadModule(element, parent);
  auto& group = context_.runtime().Create<Group>(parent, name);
  group.Annotate(std::make_unique<SourcePlace>(element.position()));
  if (is_thread) MakeThread(element, group);
  ReadGroup(element, type, group, file);
}

void FinrocReader::ReadGroup(XmlElement element, const std::string& type, FrameworkElement& group,
                             const fs::path& file) {
  for (const XmlElement child : element.children()) {
    if (child.name() == "element") ReadElement(child, group, file);
  }
  const std::string inner = StaticParameter(element, "xml_file");
  if (inner.empty()) return;
  // FINROC counts from its own root folder, which nobody here knows.
  fs::path found = file.parent_path() / inner;
  if (!fs::exists(found)) found = file.parent_path() / fs::path(inner).filename();
  if (!fs::exists(found)) {
    return Warn("the file '" + inner + "' of this " + type + " is not here",
                "put it beside " + file.filename().string(), element.position(), group);
  }
  const auto is_same = [&](const fs::path& each) { return fs::equivalent(each, found); };
  if (std::ranges::any_of(open_, is_same)) {
    return Warn(found.string() + " contains itself", "", element.position(), group);
  }
  if (documents_.size() >= kMostFiles) {
    if (std::exchange(is_too_large_, true)) return;
    return context_.Report(
        {.message = "the application has more than " + std::to_string(kMostFiles) + " groups with a file"},
        element.position(), group);
  }
  auto document = XmlDocument::Load(found);
  if (!document) return context_.Report(document.error(), element.position(), group);
  documents_.push_back(std::move(*document));
  ReadContents(documents_.back().root(), group, found);
}

void FinrocReader::MakeThread(XmlElement element, FrameworkElement& group) {
  Duration period = kUsualPeriod;
  const std::string text = StaticParameter(element, "cycle_time");
  if (const auto duration = ParseDuration(text); duration && *duration > Duration::zero()) {
    period = *duration;
  } else if (!text.empty()) {
    Warn("the cycle time '" + text + "' is no duration", "it is 40ms now", element.position(), group);
  }
  AddThread(group.name(), period, group);
}

void FinrocReader::ReadModule(XmlElement element, FrameworkElement& parent) {
  const std::string name = RunnelName(element.TextOr("name"));
  const std::string library = LibraryName(element.TextOr("group"));
  const std::string type = library + "/" + RunnelName(element.TextOr("type"));
  const ModuleRegistry& modules = context_.plugins().modules();
  LoadLibrary(library);
  if (modules.Find(type) == nullptr) {
    const auto missing = modules.Get(type);
    return Warn("there is no module type '" + type + "' for '" + element.TextOr("name") + "'", missing.error().hint,
                element.position(), parent);
  }
  const auto made = modules.Create(type, parent, name);
  if (!made) return context_.Report(made.error(), element.position(), parent);
  (*made)->Annotate(std::make_unique<SourcePlace>(element.position()));
  ReadStaticParameters(element, **made);
  if (const auto whole = Runtime::Construct(**made); !whole) {
    context_.Report(whole.error(), element.position(), parent);
  }
}

// A port passes on, so that it needs no more than a direction, which the interface is called after,
// and the type of what it is connected to.
void FinrocReader::ReadInterface(XmlElement interface, FrameworkElement& group) {
  if (&group == &application_) {
    return Warn("an application has no interface", "put what is in it into a group", interface.position(), group);
  }
  const bool is_output = RunnelName(interface.TextOr("name")).ends_with("output");
  for (const XmlElement port : interface.children()) {
    const std::string name = RunnelName(port.TextOr("name"));
    const TypeInfo* type = FindType(port.TextOr("type"));
    // The first connection tells the type where its name is FINROC's.
    for (const XmlElement edge : interface.parent()->children()) {
      if (type != nullptr || edge.name() != "edge") continue;
      const XmlAttribute* const inner = edge.Attribute(is_output ? "src" : "dest");
      const XmlAttribute* const own = edge.Attribute(is_output ? "dest" : "src");
      if (inner == nullptr || own == nullptr || LastName(RunnelPath(own->value)) != name) continue;
      const Port* const end = FindEnd(*inner, group, is_output ? PathKind::kOutput : PathKind::kInput);
      if (end != nullptr) type = &end->type();
    }
    if (type == nullptr || group.FindChild(name) != nullptr) {
      Warn(type == nullptr ? "the type '" + port.TextOr("type") + "' is not known, and no connection within tells it"
                           : "there is already an element called '" + name + "'",
           "", port.position(), group);
      continue;
    }
    context_.runtime().Create<ProxyPort>(group, name, is_output ? Port::Direction::kOutput : Port::Direction::kInput,
                                         *type);
  }
}

// With the groups of ports as FINROC has them, or as Runnel may leave them out.
Port* FinrocReader::FindEnd(const XmlAttribute& path, FrameworkElement& group, PathKind end) {
  const auto whole = RunnelPath(path.value);
  if (auto* port = FindPort({group, whole, path.value_position}, end)) return port;
  const std::string module = WithoutLast(whole, 2);
  const std::string shorter = (module.empty() ? "" : module + "/") + LastName(whole);
  return FindPort({group, shorter, path.value_position}, end);
}

void FinrocReader::ReadEdge(XmlElement edge, FrameworkElement& group) {
  const XmlAttribute* const source = edge.Attribute("src");
  const XmlAttribute* const target = edge.Attribute("dest");
  if (source == nullptr || target == nullptr) {
    return Warn("<edge> without src or dest", "", edge.position(), group);
  }
  for (const XmlAttribute* end : {source, target}) {
    if (!HasScheme(end->value)) continue;
    return Warn("'" + end->value + "' is a port of another process: the connection is left out",
                "record there and play here, or run both in one application", end->value_position, group);
  }
  ConnectOptions options = ReadFlags(edge, group);
  Port* const from = FindEnd(*source, group, PathKind::kOutput);
  Port* const to = FindEnd(*target, group, PathKind::kInput);
  for (const XmlElement child : edge.children()) ReadConversion(child, group, options);
  if ((from == nullptr || to == nullptr) && options.when_present) {
    const std::string base = group.path() + "/";
    (void)LateConnections::Of(context_.runtime())
        .Add(from != nullptr ? from->path() : base + RunnelPath(source->value),
             to != nullptr ? to->path() : base + RunnelPath(target->value), options);
    return;
  }
  if (from == nullptr || to == nullptr) {
    const XmlAttribute& lost = from == nullptr ? *source : *target;
    const std::string path = RunnelPath(lost.value);
    return Warn("there is no port '" + path + "'", "", lost.value_position, group);
  }
  if (!IsRightWay(*from, PathKind::kOutput, *to) || !IsRightWay(*to, PathKind::kInput, *from)) {
    return Warn("goes against the direction of an interface port", "", edge.position(), group);
  }
  if (options.when_present) (void)LateConnections::Of(context_.runtime());
  auto connected = Port::Connect(*from, *to, options);
  if (!connected && options.convert.empty()) {
    // FINROC casts any number into any.
    ConnectOptions casting = options;
    casting.convert = "truncate";
    if (Port::Connect(*from, *to, casting)) return;
  }
  if (!connected) Warn(connected.error().message, connected.error().hint, edge.position(), group);
}

// <conversion operation="[]" parameter="2"/>, or with operation1, parameter1, operation2 and parameter2.
void FinrocReader::ReadConversion(XmlElement conversion, FrameworkElement& group, ConnectOptions& options) {
  if (conversion.name() != "conversion") {
    return Warn("<" + conversion.name() + "> of an edge has no counterpart", "put a module between the two",
                conversion.position(), group);
  }
  for (const char* number : {"", "1", "2"}) {
    const std::string operation = conversion.TextOr(std::string("operation") + number);
    const std::string parameter = conversion.TextOr(std::string("parameter") + number);
    // What needs no name here.
    if (operation.empty() || operation == "static_cast" || operation == "ToString") continue;
    if (operation == "[]") {
      options.part += "[" + parameter + "]";
      continue;
    }
    const auto known = RegisteredConversions();
    if (std::ranges::count(known, operation, &RegisteredConversion::name) > 0) {
      options.convert = operation;
      continue;
    }
    Warn("the conversion '" + operation + "' of an edge has no counterpart",
         "register one of this name (core/conversion/conversion.h), or put a module between the two",
         conversion.position(), group);
  }
}

// "Optional", "Reconnect" and the like.
ConnectOptions FinrocReader::ReadFlags(XmlElement edge, FrameworkElement& group) {
  ConnectOptions options;
  for (const XmlAttribute& each : edge.attributes()) {
    if (each.name == "src" || each.name == "dest") continue;
    const std::string flags = RunnelName(each.value);
    const auto has = [&](const char* flag) { return flags.find(flag) != std::string::npos; };
    const bool is_flags = each.name == "flags";
    const bool is_present = is_flags && (has("optional") || has("reconnect"));
    const bool is_late = is_flags && has("neutral");
    options.when_present |= is_present;
    options.late |= is_late;
    if (is_present || is_late) continue;
    Warn("'" + each.name + "' of an edge has no counterpart: '" + each.value + "' is left out", "", each.position,
         group);
  }
  return options;
}

}  // namespace runnel::internal
