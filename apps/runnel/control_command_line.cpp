#include "apps/runnel/control_command_line.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string_view>

#include "plugins/control/change_commands.h"

namespace runnel::program {

namespace {

// Also those that are no requests: of all applications, and for shells.
std::vector<CommandForm> ControlCommands() {
  std::vector<CommandForm> all;
  for (const auto& forms : {CommandForms(), ChangeCommands()}) {
    std::ranges::copy_if(forms, std::back_inserter(all), [](const CommandForm& each) { return !each.help.empty(); });
  }
  all.push_back({.name = "ps",
                 .group = "Looking at a running application",
                 .help = "lists the running applications, and how they are",
                 .example = "ps"});
  all.push_back({.name = "complete", .help = "for the completion of shells", .example = "complete ls /robot"});
  return all;
}

// "-l,--long"; "--on-full" of "on_full".
std::string FlagsOf(const FieldForm& field) {
  std::string flags = "--" + field.name;
  std::ranges::replace(flags, '_', '-');
  return field.flags.empty() ? flags : field.flags;
}

void AddWord(CLI::App& command, const FieldForm& form, std::string& word, std::vector<std::string>& all) {
  CLI::Option* const added = form.kind == FieldForm::Kind::kTexts ? command.add_option(form.name, all, form.help)
                                                                  : command.add_option(form.name, word, form.help);
  added->required(form.place == FieldForm::Place::kWord)->type_name(form.shown);
}

void AddOption(CLI::App& command, const FieldForm& form, std::map<std::string, std::string>& said) {
  if (form.kind == FieldForm::Kind::kFlag) {
    command.add_flag_callback(
        FlagsOf(form), [&said, key = form.option(), yes = form.words[1]] { said[key] = yes; }, form.help);
    return;
  }
  const auto take = [&said, key = form.option()](const std::string& value) { said[key] = value; };
  CLI::Option* const added = command.add_option_function<std::string>(FlagsOf(form), take, form.help);
  added->required(form.name == "file")->type_name(form.shown);  // into which is recorded
  if (form.name == "count") added->check(CLI::Range(1, 1'000'000'000));
}

}  // namespace

ControlCommandLine::ControlCommandLine(CLI::App& program) {
  for (const CommandForm& form : ControlCommands()) {
    Entry& entry = entries_.emplace_back();
    CLI::App& command = *(entry.command = program.add_subcommand(form.name, form.help)->group(form.group));
    command.footer("For example: runnel " + form.example);
    ControlArguments& arguments = entry.arguments;
    arguments.command = form.name;
    if (arguments.command != "ps") {  // which is of all
      command.add_option("--app", arguments.application, "which one, by name or process, if several are running")
          ->type_name("NAME|PROCESS")
          ->check([](const std::string& text) { return text.empty() ? "an empty word names no application" : ""; });
    }
    command.prefix_command(arguments.command == "complete");
    arguments.words.resize(form.fields.size());  // whose addresses the parser keeps, too
    for (std::size_t i = 0; i < form.fields.size(); ++i) {
      const FieldForm& each = form.fields[i];
      each.is_option() ? AddOption(command, each, arguments.options)
                       : AddWord(command, each, arguments.words[i], arguments.words);
    }
  }
}

std::optional<ControlArguments> ControlCommandLine::Parsed() const {
  for (const Entry& entry : entries_) {
    if (!entry.command->parsed()) continue;
    ControlArguments arguments = entry.arguments;
    if (arguments.command == "complete") arguments.words = entry.command->remaining();
    // What was left out goes; what was given as "" stays, and is refused.
    const auto has_room = [](const CLI::Option* option) { return option->get_positional(); };
    std::size_t given = 0;
    for (const CLI::Option* each : entry.command->get_options(has_room)) given += each->count();
    if (arguments.command != "complete") arguments.words.resize(given);
    return arguments;
  }
  return {};
}

std::vector<std::string> OptionsWithValue() {
  std::vector<std::string> names{"--app"};
  for (const CommandForm& form : ControlCommands()) {
    for (const FieldForm& each : form.fields) {
      std::istringstream all(each.is_option() && each.kind != FieldForm::Kind::kFlag ? FlagsOf(each) : "");
      for (std::string name; std::getline(all, name, ',');) names.push_back(name);
    }
  }
  return names;
}

std::vector<const char*> WithNegativeValues(int count, const char* const* words) {
  std::vector<const char*> all(words, words + count);
  const std::string_view last = all.back();
  const bool is_number = last.size() > 1 && last[0] == '-' && (last[1] == '.' || (last[1] >= '0' && last[1] <= '9'));
  const auto dashes = [](const char* word) { return std::string_view(word) == "--"; };
  const bool wants_value = count > 3 && (std::string_view(all[1]) == "set" || std::string_view(all[1]) == "publish" ||
                                         std::string_view(all[1]) == "call");
  if (wants_value && std::string_view(all[static_cast<std::size_t>(count) - 2]) != "--rate" && is_number &&
      std::none_of(all.begin(), all.end(), dashes)) {
    all.insert(all.end() - 1, "--");
  }
  return all;
}

}  // namespace runnel::program
