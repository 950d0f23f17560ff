#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plugins/structure/change.h"

namespace runnel::test {

/// What a structure is, in the simplest words: names, and pairs of names. Knows the rules by which
/// changes are accepted, and nothing of how they are carried out.
class StructureModel {
 public:
  /// `root` is a group that is there; changes elsewhere are not for this model.
  explicit StructureModel(const std::string& root) { elements_[root] = {.kind = Kind::kGroup}; }

  /// All of them, or none. Whether they are accepted.
  bool Apply(const ChangeSet& changes) {
    StructureModel next = *this;
    for (const Change& change : changes) {
      if (!std::visit([&](const auto& each) { return next.Do(each); }, change)) return false;
    }
    *this = next;
    return true;
  }

  /// One line for each module, group, port and connection, sorted.
  [[nodiscard]] std::string Text() const {
    std::set<std::string> lines;
    for (const auto& [path, element] : elements_) lines.insert(LineOf(path, element));
    for (const auto& [ends, queue] : edges_) {
      lines.insert(ends.first + " > " + ends.second + " " + std::to_string(queue));
    }
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
  }

  [[nodiscard]] std::vector<std::string> Paths() const {
    std::vector<std::string> paths;
    for (const auto& [path, element] : elements_) paths.push_back(path);
    return paths;
  }
  [[nodiscard]] std::vector<std::string> PortPaths() const {
    std::vector<std::string> paths;
    for (const auto& [path, element] : elements_) {
      if (element.kind == Kind::kPort) paths.push_back(path);
      for (const auto& port : PortsOfType(element.type)) paths.push_back(path + "/" + port.first);
    }
    return paths;
  }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> Edges() const {
    std::vector<std::pair<std::string, std::string>> edges;
    for (const auto& [ends, queue] : edges_) edges.push_back(ends);
    return edges;
  }

  static std::string ModuleLine(const std::string& path, const std::string& type, const std::string& step,
                                const std::string& thread) {
    return path + " module " + type + " " + step + " " + thread;
  }
  static std::string GroupLine(const std::string& path, const std::string& thread) { return path + " group " + thread; }
  static std::string PortLine(const std::string& path) { return path + " port"; }

 private:
  enum class Kind { kGroup, kModule, kPort };
  struct Element {
    Kind kind;
    std::string type = {};
    std::string step = "1";  // the only parameter
    std::string thread = {};
  };
  struct PortInfo {
    bool is_output;
    bool is_proxy;
    std::string type;
  };

  static std::map<std::string, PortInfo> PortsOfType(const std::string& type) {
    if (type == "random/source") return {{"output/out", {true, false, "int"}}};
    if (type == "random/pass") {
      return {{"output/out", {true, false, "int"}}, {"input/in", {false, false, "int"}}};
    }
    if (type == "random/words") return {{"output/out", {true, false, "text"}}};
    return {};
  }
  static bool IsType(const std::string& type) { return !PortsOfType(type).empty(); }
  static bool HasStep(const std::string& type) { return type != "random/words"; }
  static bool IsStep(const std::string& value) { return value.size() == 1 && value[0] >= '0' && value[0] <= '9'; }
  static bool IsBelow(const std::string& path, const std::string& top) {
    return path == top || path.starts_with(top + "/");
  }
  static std::string LineOf(const std::string& path, const Element& element) {
    if (element.kind == Kind::kGroup) return GroupLine(path, element.thread);
    if (element.kind == Kind::kPort) return PortLine(path);
    return ModuleLine(path, element.type, HasStep(element.type) ? element.step : "", element.thread);
  }

  [[nodiscard]] const Element* Find(const std::string& path) const {
    const auto found = elements_.find(path);
    return found == elements_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] bool HasRoomFor(const std::string& path) const {
    const Element* const parent = Find(path.substr(0, path.find_last_of('/')));
    return parent != nullptr && parent->kind == Kind::kGroup && Find(path) == nullptr;
  }
  [[nodiscard]] std::optional<PortInfo> FindPort(const std::string& path) const {
    const Element* const element = Find(path);
    if (element != nullptr) {
      if (element->kind != Kind::kPort) return {};
      return PortInfo{element->type == "output", true, "int"};
    }
    for (const auto& [module, each] : elements_) {
      if (!path.starts_with(module + "/")) continue;
      const auto ports = PortsOfType(each.type);
      const auto port = ports.find(path.substr(module.size() + 1));
      if (port != ports.end()) return port->second;
    }
    return {};
  }
  [[nodiscard]] bool Reaches(const std::string& from, const std::string& to) const {
    if (from == to) return true;
    return std::ranges::any_of(edges_, [&](const auto& edge) {
      const std::string& next = edge.first.second;
      return edge.first.first == from && (next == to || (Find(next) != nullptr && Reaches(next, to)));
    });
  }
  bool SetAll(Element& element, const std::vector<Setting>& settings) {
    for (const Setting& each : settings) {
      if (each.parameter != "step" || !HasStep(element.type) || !IsStep(each.value)) return false;
      element.step = each.value;
    }
    return true;
  }

  bool Do(const CreateModule& change) {
    Element element{.kind = Kind::kModule, .type = change.type};
    if (!HasRoomFor(change.path) || !IsType(change.type)) return false;
    if (!SetAll(element, change.settings)) return false;
    elements_[change.path] = element;
    return true;
  }
  bool Do(const CreateGroup& change) {
    if (!HasRoomFor(change.path)) return false;
    elements_[change.path] = {.kind = Kind::kGroup};
    return true;
  }
  bool Do(const CreatePort& change) {
    if (!HasRoomFor(change.path) || change.type != "int32") return false;
    const bool is_output = change.direction == Port::Direction::kOutput;
    elements_[change.path] = {.kind = Kind::kPort, .type = is_output ? "output" : "input"};
    return true;
  }
  // Parameters of groups are no part of it.
  static bool Do(const CreateParameter&) { return false; }
  bool Do(const DeleteElement& change) {
    if (Find(change.path) == nullptr) return false;
    std::erase_if(elements_, [&](const auto& each) { return IsBelow(each.first, change.path); });
    std::erase_if(edges_, [&](const auto& edge) {
      return IsBelow(edge.first.first, change.path) || IsBelow(edge.first.second, change.path);
    });
    return true;
  }
  bool Do(const ConnectPorts& change) {
    const auto from = FindPort(change.from);
    const auto to = FindPort(change.to);
    if (!from || !to || change.from == change.to) return false;
    if (!from->is_proxy && !from->is_output) return false;
    if (!to->is_proxy && to->is_output) return false;
    if (from->type != to->type || edges_.contains({change.from, change.to})) return false;
    if (from->is_proxy && to->is_proxy && Reaches(change.to, change.from)) return false;
    edges_[{change.from, change.to}] = change.options.queue;
    return true;
  }
  bool Do(const DisconnectPorts& change) { return edges_.erase({change.from, change.to}) > 0; }
  bool Do(const SetParameter& change) {
    static const std::string kEnd = "/parameter/step";
    if (!change.path.ends_with(kEnd)) return false;
    const auto found = elements_.find(change.path.substr(0, change.path.size() - kEnd.size()));
    if (found == elements_.end() || found->second.kind != Kind::kModule) return false;
    return SetAll(found->second, {{"step", change.value}});
  }
  bool Do(const ReplaceModule& change) {
    const auto found = elements_.find(change.path);
    if (found == elements_.end() || found->second.kind != Kind::kModule) return false;
    if (!IsType(change.type)) return false;
    Element& element = found->second;
    const auto after = PortsOfType(change.type);
    for (const auto& [name, port] : PortsOfType(element.type)) {
      const std::string path = change.path + "/" + name;
      const bool is_connected = std::ranges::any_of(
          edges_, [&](const auto& edge) { return edge.first.first == path || edge.first.second == path; });
      const auto match = after.find(name);
      if (is_connected && (match == after.end() || match->second.type != port.type)) return false;
    }
    if (!HasStep(element.type) || !HasStep(change.type)) element.step = "1";
    element.type = change.type;
    return SetAll(element, change.settings);
  }
  // Threads are the tests' own.
  bool Do(const AddThread&) { return false; }
  bool Do(const ScheduleThread&) { return false; }
  static bool Do(const RenameElement&) { return false; }
  static bool Do(const CopyElement&) { return false; }
  static bool Do(const TagElement&) { return false; }
  static bool Do(const LogElement&) { return false; }
  static bool Do(const ExtensionChange&) { return false; }
  bool Do(const AssignToThread& change) {
    const auto found = elements_.find(change.path);
    if (found == elements_.end() || found->second.kind == Kind::kPort) return false;
    if (!change.thread.empty() && change.thread != "one" && change.thread != "two") return false;
    found->second.thread = change.thread;
    return true;
  }

  std::map<std::string, Element> elements_;
  std::map<std::pair<std::string, std::string>, std::size_t> edges_;
};

}  // namespace runnel::test
