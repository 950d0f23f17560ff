#include "plugins/application/dot_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <vector>

#include "core/base/characters.h"
#include "core/element/runtime.h"
#include "core/plugin/module_type_name.h"
#include "core/port/port.h"
#include "core/types/type_info.h"
#include "plugins/application_files/saving/saving.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

namespace {

// Light enough for black letters, and told apart by those who see no red or green.
constexpr std::array<const char*, 8> kColours{"#cfe3f7", "#fde2b3", "#d6efd0", "#f6d0e0",
                                              "#e3dcf4", "#f3eea0", "#c5ecea", "#e6d5c5"};
constexpr const char* kNoThread = "#f2f2f2";

/// Writes one application.
class DotWriter {
 public:
  explicit DotWriter(FrameworkElement& application) : application_(application) {}

  std::string Write() {
    application_.Visit([this](FrameworkElement& element) {
      if (element.kind() == ElementKind::kThread) NoteThread(element);
    });
    text_ = "digraph " + Quoted(application_.name()) +
            " {\n"
            "  graph [rankdir=LR, fontname=\"Helvetica\", fontsize=13, nodesep=0.28, ranksep=0.75,\n"
            "         labeljust=l, style=rounded, color=\"#8a8a8a\", bgcolor=white]\n"
            "  node [fontname=\"Helvetica\", fontsize=11, shape=plain]\n"
            "  edge [fontname=\"Helvetica\", fontsize=9, color=\"#404040\", arrowsize=0.7]\n"
            "  label=" +
            Quoted(application_.name()) + "\n  labelloc=t\n";
    WriteContents(application_, 1);
    application_.VisitAll<const Port>([this](const Port& port) { WriteEdges(port); });
    WriteKey();
    return text_ + "}\n";
  }

 private:
  void Line(int depth, const std::string& line) {
    text_ += std::string(static_cast<std::size_t>(depth) * 2, ' ') + line + "\n";
  }

  void NoteThread(const FrameworkElement& thread) {
    const std::size_t count = colours_.size();
    colours_[thread.id()] = {kColours.at(count % kColours.size()), &thread};
  }
  std::string ColourOf(const FrameworkElement& module) {
    const std::uint64_t id = AssignedThread(module);
    if (id != 0 && !colours_.contains(id)) NoteThreadElsewhere(id);
    const auto found = colours_.find(id);
    if (found == colours_.end()) return kNoThread;
    found->second.is_used = true;
    return found->second.colour;
  }
  void NoteThreadElsewhere(std::uint64_t id) {
    application_.runtime().root().Visit([&](FrameworkElement& element) {
      if (element.id() == id) NoteThread(element);
    });
  }

  void WriteContents(FrameworkElement& group, int depth) {
    for (FrameworkElement* child : group.children()) {
      const auto* const port = dynamic_cast<const Port*>(child);
      if (port != nullptr) {
        WriteInterface(*port, depth);
      } else if (IsModule(*child)) {
        WriteModule(*child, depth);
      } else if (child->kind() == ElementKind::kGroup && !internal::HoldsOnlyThreads(*child)) {
        Line(depth, "subgraph " + Quoted("cluster_" + child->path()) + " {");
        Line(depth + 1, "label=" + Quoted(child->name()));
        WriteContents(*child, depth + 1);
        // An empty box would not be drawn.
        if (child->children().empty()) {
          Line(depth + 1, Quoted(child->path()) + " [label=\"\", width=0.3, height=0.1]");
        }
        Line(depth, "}");
      }
    }
  }

  void WriteInterface(const Port& port, int depth) {
    const bool is_input = port.direction() == Port::Direction::kInput;
    Line(depth, Quoted(port.path()) + " [shape=cds, margin=\"0.08,0.03\", fontsize=10, label=" + Quoted(port.name()) +
                    ", tooltip=" + Quoted(port.path() + ": " + port.type().name()) +
                    ", style=filled, fillcolor=" + (is_input ? "\"#ffffff\"" : "\"#e9e9e9\"") + "]");
  }

  // Those that are connected; both columns from the top.
  void WriteModule(FrameworkElement& module, int depth) {
    std::vector<const Port*> inputs;
    std::vector<const Port*> outputs;
    module.VisitAll<const Port>([&](const Port& port) {
      const bool is_input = port.direction() == Port::Direction::kInput;
      if (port.incoming().empty() && port.outgoing().empty()) return;
      (is_input ? inputs : outputs).push_back(&port);
    });
    std::string label =
        R"(<table border="1" cellborder="0" cellspacing="0" cellpadding="3" color="#606060" bgcolor=")" +
        ColourOf(module) + R"(" style="rounded"><tr><td colspan="2"><b>)" + EscapedMarkup(module.name()) + "</b>";
    const std::string type = FindModuleType(module);
    if (!type.empty()) label += R"(<br/><font point-size="9">)" + EscapedMarkup(type) + "</font>";
    label += "</td></tr>";
    for (std::size_t i = 0; i < std::max(inputs.size(), outputs.size()); ++i) {
      label += "<tr>" + Cell(inputs, i, "left") + Cell(outputs, i, "right") + "</tr>";
    }
    label += "</table>";
    Line(depth, Quoted(module.path()) + " [tooltip=" + Quoted(module.path()) + ", label=<" + label + ">]");
  }

  static std::string Cell(const std::vector<const Port*>& ports, std::size_t place, const std::string& side) {
    if (place >= ports.size()) return "<td></td>";
    const Port& port = *ports[place];
    return "<td port=\"p" + std::to_string(port.id()) + "\" align=\"" + side + "\"><font point-size=\"10\">" +
           EscapedMarkup(port.name()) + "</font></td>";
  }

  std::string End(const Port& port, bool is_source) {
    const FrameworkElement* const module = FindModuleAround(port);
    if (module == nullptr) return Quoted(port.path()) + (is_source ? ":e" : ":w");
    return Quoted(module->path()) + ":p" + std::to_string(port.id()) + (is_source ? ":e" : ":w");
  }

  void WriteEdges(const Port& port) {
    for (const Connection& connection : port.outgoing()) {
      if (!connection.to->IsAtOrBelow(application_)) continue;
      std::string extra = "tooltip=" + Quoted(port.path() + " → " + connection.to->path() + ": " + port.type().name());
      if (connection.options.queue > 0) {
        extra += ", style=bold, label=" + Quoted("queue " + std::to_string(connection.options.queue));
      }
      if (connection.options.pull) extra += ", style=dashed, label=pull";
      Line(1, End(port, true) + " -> " + End(*connection.to, false) + " [" + extra + "]");
    }
  }

  static std::string ThreadText(const FrameworkElement& element) {
    const auto* const thread = dynamic_cast<const ThreadContainer*>(&element);
    if (thread == nullptr) return element.name();
    return element.name() + " (" + ActivationText(thread->options()) + ")";
  }

  void WriteKey() {
    std::string rows;
    for (const auto& [id, colour] : colours_) {
      if (!colour.is_used) continue;
      rows += "<tr><td bgcolor=\"" + colour.colour + "\" border=\"1\" width=\"22\"></td>" + "<td align=\"left\">" +
              EscapedMarkup(ThreadText(*colour.thread)) + "</td></tr>";
    }
    if (rows.empty()) return;
    Line(1,
         "\"threads\" [label=<<table border=\"0\" cellborder=\"0\" cellspacing=\"4\">"
         "<tr><td colspan=\"2\" align=\"left\"><b>threads</b></td></tr>" +
             rows + "</table>>]");
  }

  struct Colour {
    std::string colour;
    const FrameworkElement* thread;
    bool is_used = false;
  };
  FrameworkElement& application_;
  std::map<std::uint64_t, Colour> colours_;  // in the order in which the threads were made
  std::string text_;
};

}  // namespace

std::string DotText(FrameworkElement& application) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  return DotWriter(application).Write();
}

}  // namespace runnel
