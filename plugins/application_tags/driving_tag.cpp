// Ports by which something moves, though no module says so of them: <driving port="drive/twist" safe="…"/>.

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/port/driving_kind.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "core/types/duration_text.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

using internal::FileUpdate;
using internal::Saving;

/// The ports that one saving has found marked in the file.
struct SaidMarks {
  std::set<const Port*> ports;
};

// Short paths mean inputs, as far as there are any.
Port* FindMarked(const PathUse& use) {
  Port* const input = FindPort(use, PathKind::kInput);
  return input != nullptr ? input : FindPort(use, PathKind::kOutput);
}

void MarkDriving(const TagUse& use) {
  const PathUse path = PathIn(use.Get("port"), use.parent);
  Port* port = FindMarked(path);
  if (port == nullptr) port = SearchPort(path, PathKind::kInput, use.context);
  if (port == nullptr) return;
  AnyValue safe;
  if (const XmlAttribute* const text = use.Find("safe")) {
    safe = internal::ReadValue(use, *text, *port);
    if (!safe) return;
  }
  const XmlAttribute* const brake = use.Find("brake");
  const auto time = brake != nullptr ? std::optional(ParseDuration(brake->value).value()) : std::nullopt;
  const std::string kind = use.xml.TextOr("command", "");
  const auto command = kind.empty() ? DrivingKind::kUnspecified : *DrivingKindCalled(kind);
  if (auto set = port->SetDriving(true, safe, time, command); !set) use.Report(set.error(), use.xml.position());
}

std::vector<std::pair<std::string, std::string>> AttributesOf(const Port& port, const DrivingMark& mark) {
  std::vector<std::pair<std::string, std::string>> attributes;
  if (mark.safe_value) attributes.emplace_back("safe", ToText(port.type(), mark.safe_value.get()));
  if (mark.brake && *mark.brake != Duration{}) attributes.emplace_back("brake", DurationText(*mark.brake));
  if (mark.command != DrivingKind::kUnspecified) attributes.emplace_back("command", NameOf(mark.command));
  return attributes;
}

void UpdateDriving(XmlElement tag, FrameworkElement& parent, FileUpdate& update) {
  const PathUse use = PathIn(*tag.Attribute("port"), parent);
  const Port* const port = FindMarked(use);
  const auto mark = port != nullptr ? port->FindMark() : std::nullopt;
  // For the time being: by a rule, or as a replay has the place.
  const auto* const driving = port != nullptr ? port->FindAnnotation<internal::DrivingState>() : nullptr;
  if (internal::IsByRule(*PathSearch(use.base).Follow(use.path, PathKind::kInput).at) ||
      (driving != nullptr && driving->is_replaced))
    return;
  if (!mark) return update.editor().Remove(tag);
  // A module in the place of another one may not say what that one has said.
  for (const auto& [name, value] : AttributesOf(*port, *mark)) {
    if (tag.TextOr(name, "").empty()) update.editor().SetAttribute(tag, name, value);
  }
  update.saving().Note<SaidMarks>().ports.insert(port);
}

// Those of copies, and of what moved by a module that is gone: the application says it of them.
std::vector<NewElement> MissingMarks(const XmlElement*, FrameworkElement& home, Saving& saving, FileUpdate*) {
  std::vector<NewElement> elements;
  if (&home != &saving.application) return elements;
  const auto& said = saving.Note<SaidMarks>().ports;
  home.VisitAll<const Port>([&](const Port& port) {
    const auto mark = port.FindMark();
    if (!mark || said.contains(&port) || internal::IsByRule(port)) return;
    NewElement& made = elements.emplace_back(
        NewElement{.name = "driving", .attributes = {{"port", port.path().substr(home.path().size() + 1)}}});
    for (auto& each : AttributesOf(port, *mark)) made.attributes.push_back(std::move(each));
  });
  return elements;
}

}  // namespace

XmlTag DrivingTag() {
  return {
      .name = "driving",
      .summary = "something moves by what is read behind this port: the STOP of the robot holds it at its safe value",
      .parents = {"application", "group"},
      .attributes =
          {PathRule("port", true, "an input of a module, or a port of a group; an output: all that read from it"),
           {.name = "safe",
            .summary = "the value at which it stands still; if left out, zero of a velocity, or the input's default"},
           KindRule("brake", AttributeKind::kDuration,
                    "how long the way there takes from the value read last, 10 s at most; if left out, no time"),
           WordRule(
               "command", DrivingKindNames(),
               "what the value says; if left out, what its module or its unit says: m, rad a position; m/s, rad/s a "
               "velocity, which begins from 0 when a STOP or a value by hand ends; other units an effort")},
      .handle = internal::ReadAt<BuildStage::kChecks, MarkDriving>,
      .update = UpdateDriving,
      .missing = MissingMarks,
      .place = 5};
}

}  // namespace runnel
