#include "tests/architecture/include_rules.h"

namespace runnel::test {

namespace {

// Bottom to top: each may know those before it.
const std::vector<std::string> kCoreOrder = {"base",    "xml",  "types", "conversion", "lockfree", "element",
                                             "channel", "port", "paths", "log",        "module",   "plugin"};

void AddCore(std::vector<IncludeRule>& rules) {
  std::vector<std::string> below;
  for (const std::string& library : kCoreOrder) {
    const std::string folder = "core/" + library;
    rules.push_back({folder, folder, below});
    below.push_back(folder);
  }
}

void AddApplication(std::vector<IncludeRule>& rules) {
  // What runs applications knows all that every application needs, and nothing that it can do without: that
  // is attached from outside, by files of these names.
  const std::vector<std::string> application = {"core",
                                                "plugins/application",
                                                "plugins/application_files",
                                                "plugins/application_tags",
                                                "plugins/command_service",
                                                "plugins/control",
                                                "plugins/parameters",
                                                "plugins/scheduling",
                                                "plugins/timing",
                                                "plugins/structure",
                                                "plugins/supervision",
                                                "plugins/values/watched_port.h"};
  const auto attached = [&](const std::string& name, const std::string& files,
                            const std::vector<std::string>& neighbours) {
    std::vector<std::string> may_include = application;
    may_include.insert(may_include.end(), neighbours.begin(), neighbours.end());
    rules.push_back({name, files, may_include});
  };
  rules.push_back({"plugins/application", "plugins/application", application});
  attached("the trace of an application", "plugins/tracing/application_", {"plugins/tracing"});
  attached("the real-time check of an application", "plugins/real_time_check/application_",
           {"plugins/real_time_check"});
  attached("FINROC's form of an application", "plugins/finroc_files/application_", {"plugins/finroc_files"});
  attached("recordings of an application", "plugins/recording/application_",
           {"plugins/mcap", "plugins/recording", "plugins/values/port_patterns.h"});
  attached(
      "the network of an application", "plugins/network/application_",
      {"plugins/cdr_values", "plugins/network", "plugins/ros_messages/message_library.h",
       "plugins/ros_messages/names.h", "plugins/ros_messages/node_messages.h",
       "plugins/ros_services/service_endpoints.h", "plugins/wire", "plugins/wire_shared_memory/shared_memory_wire.h"});
  attached("plugins/viewers", "plugins/viewers", {"plugins/foxglove", "plugins/inspector", "plugins/web_server"});
}

void AddPlugins(std::vector<IncludeRule>& rules) {
  rules.push_back({"plugins/parameters", "plugins/parameters", {"core"}});
  rules.push_back({"the words of behaviours",
                   "plugins/behaviours/xml_",
                   {"core", "plugins/application", "plugins/application_files", "plugins/behaviours"}});
  rules.push_back({"plugins/behaviours/algorithm", "plugins/behaviours/algorithm", {}, true});
  rules.push_back(
      {"plugins/behaviours",
       "plugins/behaviours",
       {"core", "plugins/parameters", "plugins/behaviours/algorithm", "plugins/model_checker", "plugins/scheduling"}});
  rules.push_back({"plugins/model_checker", "plugins/model_checker", {"core"}});
  rules.push_back({"plugins/values", "plugins/values", {"core"}});
  rules.push_back({"plugins/cdr_values", "plugins/cdr_values", {"core"}});
  rules.push_back({"plugins/ros_messages", "plugins/ros_messages", {"core", "plugins/cdr_values"}});
  rules.push_back({"plugins/services", "plugins/services", {"core"}});
  rules.push_back({"plugins/genom_execution", "plugins/genom_execution", {"core/base", "core/lockfree"}});
  rules.push_back({"plugins/genom_standalone", "plugins/genom_standalone", {"core", "plugins/genom_execution"}});
  rules.push_back(
      {"plugins/genom_modules",
       "plugins/genom_modules",
       {"core", "plugins/genom_execution", "plugins/parameters", "plugins/scheduling", "plugins/services"}});
  rules.push_back({"plugins/genom_text", "plugins/genom_text", {"core"}});
  rules.push_back({"plugins/genom_templates", "plugins/genom_templates", {"core", "plugins/genom_text/file_text.h"}});
  rules.push_back({"plugins/genom_description", "plugins/genom_description", {"core", "plugins/genom_text"}});
  rules.push_back({"plugins/blackboards", "plugins/blackboards", {"core", "plugins/services"}});
  rules.push_back({"plugins/foxglove",
                   "plugins/foxglove",
                   {"core", "plugins/command_service", "plugins/services/callable.h", "plugins/structure",
                    "plugins/values", "plugins/web_server"}});
  rules.push_back({"plugins/application_files",
                   "plugins/application_files",
                   {"core", "plugins/manifest", "plugins/parameters", "plugins/structure"}});
  rules.push_back({"plugins/application_tags",
                   "plugins/application_tags",
                   {"core", "plugins/application_files", "plugins/parameters", "plugins/scheduling", "plugins/timing",
                    "plugins/structure", "plugins/supervision"}});
  rules.push_back(
      {"plugins/finroc_files",
       "plugins/finroc_files",
       {"core", "plugins/parameters", "plugins/application_files", "plugins/scheduling", "plugins/timing"}});
  rules.push_back({"plugins/timing", "plugins/timing", {"core"}});
  rules.push_back({"plugins/task_order", "plugins/task_order", {"core"}});
  rules.push_back({"plugins/scheduling", "plugins/scheduling", {"core", "plugins/task_order", "plugins/timing"}});
  rules.push_back(
      {"plugins/real_time_check", "plugins/real_time_check", {"core", "plugins/scheduling", "plugins/timing"}});
  rules.push_back({"plugins/testing",
                   "plugins/testing",
                   {"core", "plugins/real_time_check", "plugins/scheduling", "plugins/timing"}});
  rules.push_back({"plugins/crash_report", "plugins/crash_report", {"core", "plugins/scheduling", "plugins/timing"}});
  rules.push_back({"plugins/structure", "plugins/structure", {"core", "plugins/scheduling", "plugins/timing"}});
  rules.push_back(
      {"plugins/tracing", "plugins/tracing", {"core", "plugins/values", "plugins/scheduling", "plugins/timing"}});
  rules.push_back({"plugins/command_service",
                   "plugins/command_service",
                   {"core", "plugins/scheduling", "plugins/timing", "plugins/structure"}});
  rules.push_back({"plugins/control",
                   "plugins/control",
                   {"core", "plugins/command_service", "plugins/scheduling", "plugins/timing", "plugins/structure",
                    "plugins/services/callable.h", "plugins/values/watched_port.h"}});
  rules.push_back({"plugins/manifest", "plugins/manifest", {"core", "plugins/values"}});
  rules.push_back({"plugins/mcap", "plugins/mcap", {"core"}});
  rules.push_back({"plugins/wire", "plugins/wire", {"core"}});
  rules.push_back({"the words of networks",
                   "plugins/network/xml_",
                   {"core", "plugins/application_files", "plugins/network", "plugins/network_discovery",
                    "plugins/ros_messages/message_library.h", "plugins/ros_messages/names.h", "plugins/ros_services",
                    "plugins/services", "plugins/structure", "plugins/values/port_patterns.h", "plugins/wire"}});
  rules.push_back({"plugins/network",
                   "plugins/network",
                   {"core", "plugins/cdr_values", "plugins/network_discovery", "plugins/ros_messages",
                    "plugins/ros_services", "plugins/services/callable.h", "plugins/values/json_writer.h",
                    "plugins/values/port_patterns.h", "plugins/wire"}});
  rules.push_back(
      {"plugins/network_discovery",
       "plugins/network_discovery",
       {"core", "plugins/cdr_values", "plugins/ros_messages", "plugins/values/port_patterns.h", "plugins/wire"}});
  rules.push_back({"plugins/ros_services",
                   "plugins/ros_services",
                   {"core", "plugins/cdr_values", "plugins/network_discovery", "plugins/ros_messages",
                    "plugins/services", "plugins/wire"}});
  rules.push_back({"plugins/wire_shared_memory", "plugins/wire_shared_memory", {"core", "plugins/wire"}});
  rules.push_back({"plugins/wire_cyclone", "plugins/wire_cyclone", {"core", "plugins/wire"}});
  rules.push_back({"plugins/wire_fast", "plugins/wire_fast", {"core", "plugins/wire"}});
  rules.push_back({"plugins/python", "plugins/python", {"core"}});
  rules.push_back({"plugins/recording",
                   "plugins/recording",
                   {"core", "plugins/values", "plugins/mcap", "plugins/application_files", "plugins/parameters",
                    "plugins/scheduling", "plugins/services", "plugins/structure", "plugins/timing"}});
  rules.push_back({"plugins/web_server", "plugins/web_server", {"core"}});
  rules.push_back({"the tags of the inspector",
                   "plugins/inspector/xml_",
                   {"core", "plugins/inspector", "plugins/application_files", "plugins/web_server"}});
  rules.push_back(
      {"plugins/inspector",
       "plugins/inspector",
       {"core", "plugins/command_service", "plugins/manifest", "plugins/services/callable.h", "plugins/values",
        "plugins/scheduling", "plugins/timing", "plugins/structure", "plugins/web_server"}});
  rules.push_back(
      {"plugins/supervision",
       "plugins/supervision",
       {"core", "plugins/parameters/value_to_save.h", "plugins/scheduling", "plugins/timing", "plugins/structure"}});
}

// A family of modules knows the framework, the types that all share, and itself. Neighbours that a
// family needs besides are declared here, one by one.
void AddFamily(std::vector<IncludeRule>& rules, const std::string& name,
               const std::vector<std::string>& neighbours = {}) {
  const std::string folder = "modules/" + name;
  rules.push_back({folder + "/algorithm", folder + "/algorithm", {"modules/types/algorithm"}, true});
  std::vector<std::string> may_include = {"core", "plugins/parameters", "modules/types", folder};
  may_include.insert(may_include.end(), neighbours.begin(), neighbours.end());
  rules.push_back({folder, folder, may_include});
}

void AddModules(std::vector<IncludeRule>& rules) {
  // A list, as the standard's are.
  rules.push_back({"modules/types/algorithm", "modules/types/algorithm", {"core/base/shared_vector.h"}, true});
  rules.push_back({"modules/types", "modules/types", {"core", "modules/types/algorithm"}});
  for (const char* family : {"adaptors", "flow", "motion", "planning", "sensors", "signal"}) {
    AddFamily(rules, family);
  }
  // Behaviours of a robot, and a fusion of values of any type.
  AddFamily(rules, "behaviours", {"plugins/behaviours", "modules/flow"});
  AddFamily(rules, "places", {"plugins/blackboards", "plugins/services"});
  AddFamily(rules, "simulation", {"plugins/values"});  // the referee's result
  // Worlds made and measured: no modules, and what a world is, the simulation says.
  rules.push_back(
      {"modules/worlds", "modules/worlds", {"modules/types/algorithm", "modules/simulation/algorithm"}, true});
}

std::vector<IncludeRule> MakeProjectRules() {
  std::vector<IncludeRule> rules;
  AddCore(rules);
  AddApplication(rules);  // first, for its files in other folders
  AddPlugins(rules);
  AddModules(rules);
  // The programs beside the main one that make worlds and compare planners in them. They run
  // applications by starting the main program, and link no module.
  for (const char* program : {"apps/arena", "apps/world"}) {
    rules.push_back({program,
                     program,
                     {"apps/program.h", "core", "modules/types/algorithm", "modules/simulation/algorithm",
                      "modules/simulation/world_file", "modules/worlds/algorithm"}});
  }
  rules.push_back({"apps/headers", "apps/headers", {"core", "plugins", "modules/types"}});
  rules.push_back({"apps", "apps", {"core", "plugins"}});
  // Apart, since a benchmark of whole applications runs them as the tests do.
  rules.push_back({"tests/bench", "tests/bench", {"core", "bench", "tests/support"}});
  for (const char* folder : {"tests", "bench"}) {
    rules.push_back({folder, folder, {"core", "plugins", "modules", "apps", "tests", "bench"}});
  }
  return rules;
}

}  // namespace

const std::vector<IncludeRule>& ProjectRules() {
  static const std::vector<IncludeRule> rules = MakeProjectRules();
  return rules;
}

}  // namespace runnel::test
