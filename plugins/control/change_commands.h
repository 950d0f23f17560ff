#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/command_service/request_table.h"

namespace runnel {

/// The commands of the terminal that are changes of the structure, by the table of these. Static.
[[nodiscard]] const std::vector<CommandForm>& ChangeCommands();

/// By which form its words are read; of "create", they say which: "create port PATH". nullptr: it is none of these.
[[nodiscard]] const ChangeForm* FindChangeCommand(std::string_view command, const std::vector<std::string>& words);
/// What the words and options say in the text format of changes; what is wrong with them is for its reader to say.
/// "": it is no such command.
[[nodiscard]] std::string ChangeTextOf(std::string_view command, const std::vector<std::string>& words,
                                       const std::map<std::string, std::string>& options);

}  // namespace runnel
