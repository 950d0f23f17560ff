#pragma once

#include <span>
#include <string>

#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_standalone/standalone_port.h"

namespace runnel::genom_standalone {

struct StandaloneParameter {
  const char* name;
  std::size_t offset;  ///< in the data of a request
  const ValueType* type;
  bool is_input;
  bool is_output;
  const char* initial = "";  ///< JSON, "" if the description says none
};

struct StandaloneService {
  std::span<const StandaloneParameter> parameters = {};
};

struct StandalonePortEntry {
  const char* name;
  StandalonePort* port;               ///< or
  StandaloneMultiplePort* ports = nullptr;
};

struct StandaloneDetail {
  genom_execution::Event exception;
  const ValueType* type;
};

/// A component as a process: what a template makes, for RunStandalone().
struct StandaloneComponent {
  const genom_execution::ComponentTable& table;
  void* ids;  ///< made; nullptr: it has none
  std::span<const StandaloneService> services = {};  ///< as in the table
  std::span<const StandalonePortEntry> ports = {};
  std::span<const StandaloneDetail> details = {};
};

/// A value as JSON.
[[nodiscard]] std::string TextOf(const ValueType& type, const void* value);

/// The main function of such a process: runs the component by threads of its own, one for each task, and answers requests
/// in JSON lines over a Unix socket until it is told to end, or by SIGINT or SIGTERM. With --stepped it has no thread and no
/// clock but what requests say, and does the same each time. Returns the process' exit code.
[[nodiscard]] int RunStandalone(const StandaloneComponent& component, int count, char** words);

}  // namespace runnel::genom_standalone
