#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/element/configurable.h"
#include "core/log/log_level.h"
#include "core/port/port.h"
#include "core/port/port_options.h"
#include "plugins/scheduling/thread_options.h"

namespace runnel {

class TypeInfo;
namespace internal {
class ElementState;
struct ParameterRecord;
}  // namespace internal

/// The value of a parameter in its text format, by the parameter's name: {"stop_distance", "0.3"}.
struct Setting {
  std::string parameter;
  std::string value;
  friend bool operator==(const Setting& a, const Setting& b) = default;
};

using GivenState = std::shared_ptr<const internal::ElementState>;
using GivenParameters = std::shared_ptr<const std::vector<internal::ParameterRecord>>;

// Paths are absolute: "/application/robot/planner". The name of the only application may be left out:
// "/robot/planner". Those of ports and parameters may leave out the group: "/robot/planner/pose".

/// A module of a registered type, made, configured and prepared beside the tree, then put in.
struct CreateModule {
  std::string path;
  std::string type;
  std::vector<Setting> settings = {};
  /// Of a change that makes again, or makes another one like: all that had been set there. So of the others.
  GivenState state = {};
};

struct CreateGroup {
  std::string path;
  GivenState state = {};
};

/// A port in the interface of a group.
struct CreatePort {
  std::string path;
  Port::Direction direction = Port::Direction::kInput;
  std::string type;  ///< name of the data type, as a loaded plugin has described it
  std::string description = {};
  GivenState state = {};
};

/// A parameter of a group that stands for some of what is within (GroupParameter).
struct CreateParameter {
  std::string path;
  std::vector<std::string> targets;  ///< parameters as seen from the group: "motor/radius"
  std::string description = {};
  GivenState state = {};
};

/// With all that is below it and all its connections.
struct DeleteElement {
  std::string path;
};

struct ConnectPorts {
  std::string from;  ///< may name a part of the values: "/world/pose.x", "/laser/scan.ranges[0]"
  std::string to;
  ConnectOptions options = {};
};

struct DisconnectPorts {
  std::string from;
  std::string to;
};

struct SetParameter {
  std::string path;
  std::string value;  ///< text format
  /// Instead of the text, an object of `type`, which must be the parameter's.
  std::shared_ptr<const void> object = {};
  const TypeInfo* type = nullptr;
  Configurable::Own own = {};  ///< of what is put back
};

/// Puts a module of `type` in the place of another one. It takes over the connections (what waits in
/// queues, what has been read), values of parameters of the same name that have been set or given,
/// and kept states of the same type (KeepState). `settings` come last. The same type makes the module
/// anew, as after a fault.
struct ReplaceModule {
  std::string path;
  std::string type;
  std::vector<Setting> settings = {};
  /// If the new module throws in one of so many first cycles, the old one comes back as it was.
  std::uint64_t probation_cycles = 10;
  /// Of a change that takes another one back: what had been set at ports that the module has not, and gets again.
  GivenState state = {};
  /// And its parameters, which are as they were then, but for what has been set or given since.
  GivenParameters parameters = {};
};

/// Gives a module or group another name, at the same place. Connections (with what waits in queues), values, kept states
/// and threads stay: its modules are made anew by their types and take over, as a replacement of the same type does. What
/// names it by its path follows: connections that wait, parameters of groups, the file when it is saved.
struct RenameElement {
  std::string path;
  std::string name;  ///< the last part of the new path
};

/// Makes another module or group like one, beside it, with its values and threads, and what is connected within. To
/// others it is connected nowhere, and it remembers nothing.
struct CopyElement {
  std::string path;
  std::string name = {};  ///< "": the first that is free
};

/// Has the element, and what is below it and not assigned otherwise, run by another thread container.
struct AssignToThread {
  std::string path;
  std::string thread;  ///< name of the container; "" takes the assignment back
};

/// Says something of an element to viewers, instead of what has been said (core/element/tags.h).
struct TagElement {
  std::string path;
  std::vector<std::string> tags;  ///< none: nothing is said any more
};

/// Says from which level on what is at and below the path logs.
struct LogElement {
  std::string path;                    ///< "/": of everything
  std::optional<LogLevel> level = {};  ///< none: as what is around it
};

/// Makes a thread container.
struct AddThread {
  std::string name;  ///< or its path
  ThreadOptions options = {};
};

/// Gives a thread other options, from one of its next cycles on; what is not said stays. A thread is deleted as other
/// elements are.
struct ScheduleThread {
  std::string thread;  ///< its name or path
  std::optional<Duration> period = {};
  std::optional<int> priority = {};
  std::optional<ThreadOptions::OnOverrun> on_overrun = {};
  std::optional<ThreadOptions::Activation> activation = {};
};

/// What an extension of the application carries out, under the word that it has for it (ExtensionChanges): that a port is
/// offered to other applications, for example.
struct ExtensionChange {
  std::string verb;
  std::vector<std::string> words;
  std::vector<Setting> settings = {};
  /// Of a change that takes another one back: all that has to be as it was, the extension's own.
  std::shared_ptr<const void> state = {};
};

using Change = std::variant<CreateModule, CreateGroup, CreatePort, CreateParameter, DeleteElement, ConnectPorts,
                            DisconnectPorts, SetParameter, ReplaceModule, AssignToThread, AddThread, ScheduleThread,
                            RenameElement, CopyElement, TagElement, LogElement, ExtensionChange>;

/// Changes that belong together, in the order in which they build on one another.
using ChangeSet = std::vector<Change>;

}  // namespace runnel
