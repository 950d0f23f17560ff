#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace runnel {

struct ChangeForm;

/// A word of a command of the terminal, in its place.
struct CommandWord {
  std::string name;
  std::string help;
  std::string shown;  ///< what stands for it, for people: "PATH"
  bool is_needed = true;
  std::size_t most = 1;  ///< that there may be of it
};

/// An option of such a command.
struct CommandOption {
  std::string names;  ///< on the command line: "-l,--long"
  std::string key;    ///< in the request: "long"
  std::string help;
  std::string shown = {};    ///< in the place of its value, for people: "N"; "": it has none
  std::string said = "yes";  ///< in the request, of one without a value
  bool is_needed = false;
};

/// A command of the terminal that is for a running application: all that the command line, its completion and the
/// server of the socket know of its words.
struct CommandForm {
  std::string group;  ///< of the help; "": it is in none
  std::string name;
  std::string example;  ///< what is written behind "runnel"
  std::string help;
  std::vector<CommandWord> words = {};
  std::vector<CommandOption> options = {};

  [[nodiscard]] std::size_t least_words() const;
  [[nodiscard]] std::size_t most_words() const;
};

/// Those that are requests of the same name. Static.
[[nodiscard]] const std::vector<CommandForm>& CommandForms();
/// Those that are changes of the structure, by the table of these (plugins/structure/change_fields.h). Static.
[[nodiscard]] const std::vector<CommandForm>& ChangeCommands();

/// By which form its words are read; of "create", they say which: "create port PATH". nullptr: it is none of these.
[[nodiscard]] const ChangeForm* FindChangeCommand(std::string_view command, const std::vector<std::string>& words);
/// What the words and options say in the text format of changes; what is wrong with them is for its reader to say.
/// "": it is no such command.
[[nodiscard]] std::string ChangeTextOf(std::string_view command, const std::vector<std::string>& words,
                                       const std::map<std::string, std::string>& options);

}  // namespace runnel
