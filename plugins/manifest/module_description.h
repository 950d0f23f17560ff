#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"

namespace runnel {

/// What modules of a type look like, as who composes applications wants to know it: data, without a module.
struct ModuleDescription {
  struct Port {
    std::string name;
    std::string group;  ///< "input", "output", "sensor_output" …
    bool is_input = false;
    std::string type;
    bool is_required = false;
    std::string description;

    /// As paths have it: "scan", or "sensor_output/pose" where the group's name is no usual one.
    [[nodiscard]] std::string PathInModule() const;
  };
  struct Parameter {
    std::string name;
    std::string type;
    std::string unit;
    std::string default_value;  ///< text format
    std::string bounds;         ///< "0.05 .. 5"
    std::optional<double> minimum;
    std::optional<double> maximum;
    std::vector<std::string> choices;  ///< of an enumeration
    bool is_static = false;
    std::string description;
  };

  std::string type;
  std::string summary = {};
  std::string plugin = {};
  std::vector<Port> ports = {};
  std::vector<Parameter> parameters = {};
  std::string problem = {};  ///< why no module of it can be made; "" if one can
};

/// What a module looks like, its ports and parameters.
[[nodiscard]] ModuleDescription DescribeModule(const ModuleType& type, const FrameworkElement& module);

/// The same by making a module beside the tree of `runtime`, under the structure lock, and destroying it: for
/// types whose plugin has no manifest. nullopt if there is no such type (any more).
/// Errors:   why none can be made is in ModuleDescription::problem.
/// Threads:  one that may wait.
[[nodiscard]] std::optional<ModuleDescription> DescribeByMaking(Runtime& runtime, const ModuleRegistry& modules,
                                                                const std::string& type);

/// Module types as JSON, for programs: a list of {"type", "summary", "plugin", "problem", "ports": [{"name", "group",
/// "direction", "type", "required", "description"}], "parameters": [{"name", "type", "unit", "default", "minimum",
/// "maximum", "choices", "static", "description"}]}; null for what there is none of.
[[nodiscard]] std::string JsonText(const std::vector<ModuleDescription>& modules);

/// One of them.
void AppendJson(const ModuleDescription& module, std::string& json);

}  // namespace runnel
