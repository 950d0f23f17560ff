#pragma once

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_text.h"

namespace runnel::test {

using Json = nlohmann::json;

/// A change in its text format, which is shorter to write, as the protocol has it.
inline Json ChangeMessage(const std::string& text) {
  Diagnostics diagnostics;
  const PlacedChanges placed = ParseChanges(text, {}, diagnostics);
  if (!diagnostics.ok() || placed.changes.size() != 1) {
    ADD_FAILURE() << "no change: " << text;
    return {};
  }
  struct Writer {
    Json operator()(const CreateModule& change) const {
      Json json{{"change", "create"}, {"path", change.path}, {"type", change.type}};
      for (const auto& [name, value] : change.settings) json["settings"][name] = value;
      return json;
    }
    Json operator()(const CreateGroup& change) const { return {{"change", "create_group"}, {"path", change.path}}; }
    Json operator()(const CreatePort& change) const {
      const bool is_input = change.direction == Port::Direction::kInput;
      return {{"change", "create_port"},
              {"path", change.path},
              {"direction", is_input ? "input" : "output"},
              {"type", change.type}};
    }
    Json operator()(const CreateParameter& change) const {
      return {{"change", "create_parameter"}, {"path", change.path}, {"targets", change.targets}};
    }
    Json operator()(const DeleteElement& change) const { return {{"change", "delete"}, {"path", change.path}}; }
    Json operator()(const ConnectPorts& change) const {
      return {{"change", "connect"}, {"from", change.from}, {"to", change.to}, {"queue", change.options.queue}};
    }
    Json operator()(const DisconnectPorts& change) const {
      return {{"change", "disconnect"}, {"from", change.from}, {"to", change.to}};
    }
    Json operator()(const SetParameter& change) const {
      return {{"change", "set"}, {"path", change.path}, {"value", change.value}};
    }
    Json operator()(const ReplaceModule& change) const {
      return {
          {"change", "replace"}, {"path", change.path}, {"type", change.type}, {"probation", change.probation_cycles}};
    }
    Json operator()(const AssignToThread& change) const {
      return {{"change", "move"}, {"path", change.path}, {"thread", change.thread}};
    }
    Json operator()(const RenameElement& change) const {
      return {{"change", "rename"}, {"path", change.path}, {"name", change.name}};
    }
    Json operator()(const TagElement& change) const {
      std::string tags;
      for (const std::string& tag : change.tags) tags += (tags.empty() ? "" : " ") + tag;
      return {{"change", "tag"}, {"path", change.path}, {"tags", tags}};
    }
    Json operator()(const LogElement& change) const {
      const std::string level = change.level ? LogLevelName(*change.level) : "inherit";
      return {{"change", "log"}, {"path", change.path}, {"level", level}};
    }
    Json operator()(const ExtensionChange& change) const {
      Json json{{"change", change.verb}, {"words", change.words}};
      for (const auto& [name, value] : change.settings) json["settings"][name] = value;
      return json;
    }
    Json operator()(const CopyElement& change) const {
      return {{"change", "copy"}, {"path", change.path}, {"name", change.name}};
    }
    Json operator()(const AddThread& change) const {
      return {{"change", "create_thread"},
              {"path", change.name},
              {"activation", ActivationNames()[static_cast<std::size_t>(change.options.activation)]},
              {"period", ToSeconds(change.options.period)},
              {"priority", change.options.priority}};
    }
    Json operator()(const ScheduleThread& change) const {
      Json json{{"change", "schedule"}, {"path", change.thread}};
      if (change.period) json["period"] = ToSeconds(*change.period);
      if (change.priority) json["priority"] = *change.priority;
      if (change.activation) {
        json["activation"] = ActivationNames()[static_cast<std::size_t>(*change.activation)];
      }
      return json;
    }
  };
  return std::visit(Writer{}, placed.changes.front());
}

}  // namespace runnel::test
