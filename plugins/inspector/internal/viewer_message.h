#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/robot_stop.h"
#include "plugins/structure/change.h"
#include "plugins/values/json_reader.h"

namespace runnel::internal {

/// What is wrong with a request; `change`: with which of its changes, from 0.
struct RequestError {
  Error error;
  std::optional<std::size_t> change = {};
};

/// What a viewer says, as the protocol has it; what is not said is as here.
struct ViewerMessage {
  std::string op;
  std::optional<std::uint64_t> request;
  std::vector<std::string> fields;  ///< the names of all that it says, whether anybody knows them or not
  std::string path;
  std::string label;
  std::string client;                 ///< whose message it is; is never read from it
  std::optional<Time> received = {};  ///< by the machine's clock; likewise
  RobotStop::AsOf as_of = {};         ///< likewise
  ChangeSet changes;
  std::map<std::string, std::string> entries;  ///< of the arrangement
  std::vector<RequestError> wrong_changes;     ///< of what is no change; then `changes` has not all
  std::string file;
  std::string plugin;
  std::string level;
  std::string from;  ///< where a latency begins, and where it ends
  std::string to;
  bool wants_image = false;  ///< a picture as a browser takes it
  std::string value;
  std::optional<double> rate;
  std::optional<double> deadline;  ///< s
  std::string lease;
  std::optional<Time> at;  ///< of a release: "at" of the newest `alive`; of an `alive`: of the one that it answers
  std::optional<double> speed;
  std::size_t elements = 12;
  std::uint64_t cycles = 1;
  bool is_on = true;
  bool saves_configuration = false;
  bool overwrites = false;           ///< another application's file
  bool may_end_application = false;  ///< by deleting it
};

/// One change as PROTOCOL.md has it: {"change":"connect","from":"/a/out","to":"/b/in","queue":10}.
/// Errors: it is no object, there is no such change (with the nearest name), a member is missing, unknown
/// or of another kind.
[[nodiscard]] Result<Change> ParseChange(const JsonPart& json);

/// Errors: it is no JSON object, is nested deeper than any message is, or a member is of another kind
/// than the protocol has it. Whether its operation has all of its members, CheckFields() says. `number` is the request's, so that what is wrong can be answered with it.
[[nodiscard]] Result<ViewerMessage> ParseViewerMessage(std::string_view text,
                                                       std::optional<std::uint64_t>* number = nullptr);

}  // namespace runnel::internal
