#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "plugins/command_service/command_request.h"
#include "plugins/structure/change_fields.h"

namespace runnel {

using RequestField = FieldForm;

/// A request that clients offer under the same name: the terminal, pages, Foxglove, Python; or the terminal alone.
struct RequestForm {
  std::string name;
  std::string group;  ///< in the help of the terminal; "": it is no command there
  std::string role;   ///< that a client needs: "look", "drive", "change"; "": only the terminal has it
  /// Whether something may move by it, and not only stop: then it is refused if STOP was pressed or released after it was
  /// asked for (CommandService::Begin()).
  bool lets_move = false;
  std::string help = {};     ///< one line
  std::string example = {};  ///< as words of the terminal
  std::vector<RequestField> fields = {};
  /// That a client needs for the whole application, where that is less: who drives may have all of it stand still, but not
  /// leave out one module, which may be what keeps the robot from colliding. "": as `role`.
  std::string role_of_whole = {};
};
using DescribedRequest = RequestForm;
using CommandForm = RequestForm;

/// The commands of the terminal that are requests of the same name: the command line is made of it. Static.
[[nodiscard]] const std::vector<CommandForm>& CommandForms();

/// Those that all clients have. Static.
[[nodiscard]] const std::vector<DescribedRequest>& RequestTable();
/// Errors: there is no such request, with the nearest name.
[[nodiscard]] Result<const DescribedRequest*> FindRequest(std::string_view name);

/// That column. What is no request moves nothing: clients look and write by it. Of changes of the structure: whether one of
/// them may let something move.
[[nodiscard]] bool LetsMove(std::string_view name);
[[nodiscard]] bool LetsMove(const CommandRequest& request);
[[nodiscard]] bool LetsMove(const ChangeSet& changes);

/// What releases the STOP of the robot, in the place of a port's path.
inline constexpr std::string_view kRobotStopName = "stop";

/// By name. Numbers and texts, as a client has them.
using RequestFields = std::map<std::string, std::variant<std::string, double>, std::less<>>;

/// The request for CommandService::Begin(). `client`: who wants it, for people: "a terminal", "viewer 2".
/// Errors: an unknown request or field, with the nearest name; a field that is missing, empty or of the wrong kind; one
/// that clients make by themselves.
[[nodiscard]] Result<CommandRequest> MakeRequest(std::string_view name, const RequestFields& fields,
                                                 const std::string& client);

}  // namespace runnel
