// <connect>, as the files that are saved have it.

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/element/element_path.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/port/parameter_input.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel::internal {

std::string TakePart(PathUse& use) {
  const auto found = PathSearch(use.base).FindPortPart(use.path, PathKind::kOutput);
  const std::string part = found ? found->part : "";
  PortPathPart split{use.path, part};
  if (!part.empty()) split.path.resize(split.path.size() - part.size() - (part.front() == '[' ? 0 : 1));
  const bool is_parent = use.path == ".." || use.path.ends_with("/..");
  if (!found && !is_parent) split = SplitPortPath(use.path);  // perhaps the port is not there yet
  use.path = split.path;
  return split.part;
}

std::string AbsolutePath(const PathUse& use) {
  if (IsAbsolutePath(use.path)) return use.path;
  std::string path = std::filesystem::path(use.base.path() + "/" + use.path).lexically_normal().string();
  if (path.ends_with('/')) path.pop_back();
  return path;
}

namespace {

std::string RelativePath(const FrameworkElement& home, const std::string& path) {
  return path.starts_with(home.path() + "/") ? path.substr(home.path().size() + 1) : path;
}

// As short as it may be, seen from `home`.
std::string PathFrom(FrameworkElement& home, const Port& port, PathKind kind) {
  if (const std::string& distant = DistantPathOf(port); !distant.empty()) return distant;
  const std::string full = LastingPath(port).substr(home.path().size() + 1);
  const FrameworkElement* group = port.parent();
  const FrameworkElement* const fed = ParameterSetBy(port);
  if (fed != nullptr) group = fed->parent();
  if (group->kind() != ElementKind::kPortGroup) return full;
  std::string module = group->parent()->path().substr(home.path().size());
  if (!module.empty()) module.erase(0, 1);
  const std::string shorter = module + "/" + (fed != nullptr ? fed : &port)->name();
  return FindPort({home, shorter, {}}, kind) == &port ? shorter : full;
}

struct OptionText {
  AttributeRule rule;
  std::string usual;
  std::string value;
  friend bool operator==(const OptionText& a, const OptionText& b) { return a.value == b.value; }
};

// What a file says of a connection; it need not say what is usual.
std::array<OptionText, 6> TextsOf(const ConnectOptions& options) {
  const OnFull on_full = options.queue > 0 ? options.on_full : OnFull::kDropOldest;
  return {{{{.name = "queue", .kind = AttributeKind::kCount}, "0", std::to_string(options.queue)},
           {{.name = "on_full"}, OnFullNames()[0], OnFullNames()[static_cast<std::size_t>(on_full)]},
           {{.name = "pull"}, "false", options.pull ? "true" : "false"},
           {{.name = "convert"}, "", options.convert},
           {{.name = "when"}, "", options.when_present ? "present" : ""},
           {{.name = "late"}, "false", options.late ? "true" : "false"}}};
}

bool SaysOptions(XmlElement tag, const ConnectOptions& options) {
  return std::ranges::all_of(TextsOf(options), [&](const OptionText& each) {
    return MeanTheSame(each.rule, tag.TextOr(each.rule.name, each.usual), each.value);
  });
}

// Whether a tag says it already; if not, and the tag may be changed, the tag says it from now on.
bool SaysConnection(XmlElement tag, const PathUse& from_use, const std::string& part, const PathUse& to_use,
                    bool is_only_one, FileUpdate& update) {
  Port* const from = FindPort(from_use, PathKind::kOutput);
  Port* const to = FindPort(to_use, PathKind::kInput);
  const bool is_there = from != nullptr && to != nullptr;
  std::vector<SavedEdge>& edges = update.saving().edges;
  const LateConnections* const late = is_there ? nullptr : LateConnections::FindIn(from_use.base.runtime());
  const LateConnection* const awaited =
      late != nullptr ? late->Find(AbsolutePath(from_use), AbsolutePath(to_use)) : nullptr;
  const auto edge = std::ranges::find_if(edges, [&](const SavedEdge& each) {
    if (is_there) return each.from == from && each.to == to;
    if (to != nullptr && each.to == to && each.from_path == from_use.path) return true;
    return awaited != nullptr && each.from_path == awaited->from && each.to_path == awaited->to;
  });
  // One that leads out of the application is left to whoever wrote it.
  if (edge == edges.end() && is_there && from->ConnectionTo(*to) != nullptr) return true;
  if (edge == edges.end() || edge->is_saved) {
    update.Touch(from);
    update.Touch(to);
    return false;
  }
  const bool is_same_part = part == edge->options.part;
  if (!is_same_part || !SaysOptions(tag, edge->options)) {
    if (!is_only_one) return false;
    if (!is_same_part) {
      update.editor().SetAttribute(tag, "from", from_use.path + edge->options.PartText());
    }
    for (const auto& [rule, usual, value] : TextsOf(edge->options)) {
      value == usual ? update.editor().RemoveAttribute(tag, rule.name)
                     : update.editor().SetAttribute(tag, rule.name, value);
    }
  }
  edge->is_saved = true;
  return true;
}

}  // namespace

void UpdateConnect(XmlElement tag, FrameworkElement& group, FileUpdate& update) {
  const XmlAttribute& to_list = *tag.Attribute("to");
  PathUse from = PathIn(*tag.Attribute("from"), group);
  const std::string part = TakePart(from);
  const std::vector<PathUse> targets = PathsIn(to_list, group);
  std::set<std::size_t> gone;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (!SaysConnection(tag, from, part, targets[i], targets.size() == 1, update)) gone.insert(i);
  }
  if (gone.size() == targets.size()) {
    update.editor().Remove(tag);
  } else {
    update.editor().RemoveWords(to_list, gone);
  }
}

std::vector<NewElement> MissingConnections(const XmlElement*, FrameworkElement& home, Saving& saving, FileUpdate*) {
  std::vector<NewElement> elements;
  const SavedEdge* last = nullptr;
  for (SavedEdge& edge : saving.edges) {
    if (edge.is_saved || edge.home != &home) continue;
    edge.is_saved = true;
    const std::string to =
        edge.to != nullptr ? PathFrom(home, *edge.to, PathKind::kInput) : RelativePath(home, edge.to_path);
    const std::string from =
        edge.from != nullptr ? PathFrom(home, *edge.from, PathKind::kOutput) : RelativePath(home, edge.from_path);
    const bool goes_on = last != nullptr && last->from == edge.from && last->from_path == edge.from_path &&
                         last->options.part == edge.options.part && TextsOf(last->options) == TextsOf(edge.options);
    last = &edge;
    if (goes_on) {
      elements.back().attributes[1].second += " " + to;
      continue;
    }
    NewElement& made = elements.emplace_back(
        NewElement{.name = "connect", .attributes = {{"from", from + edge.options.PartText()}, {"to", to}}});
    for (const auto& [rule, usual, value] : TextsOf(edge.options)) {
      if (value != usual) made.attributes.emplace_back(rule.name, value);
    }
  }
  return elements;
}

}  // namespace runnel::internal
