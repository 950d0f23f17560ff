// The commands of the terminal that are changes, as the table of changes describes them.

#include <algorithm>
#include <map>
#include <sstream>

#include "plugins/control/command_forms.h"
#include "plugins/structure/change_arguments.h"
#include "plugins/structure/change_fields.h"

namespace runnel {

namespace {

using internal::AsArgument;
using FieldKind = ChangeField::Kind;

const std::string& CommandOf(const ChangeForm& form) { return form.command.empty() ? form.name : form.command; }

// Of any name: they are words of the command, "name=value".
bool AreWords(const ChangeField& field) { return field.kind == FieldKind::kSettings && field.known.empty(); }

// "--on-full" of "on_full"; what an extension calls something is left as it is.
CommandOption OptionOf(const ChangeField& field, bool is_own = true) {
  std::string name = "--" + field.name;
  if (is_own) std::ranges::replace(name, '_', '-');
  const bool is_flag = field.kind == FieldKind::kFlag;
  return {name, field.option(), field.help, is_flag ? "" : field.shown, is_flag ? field.words[1] : ""};
}

CommandForm CommandFormOf(const ChangeForm& change) {
  CommandForm form{"Changing it", CommandOf(change), "", change.help};
  CommandWord all{"words", change.words_help, ""};
  for (const ChangeField& field : change.fields) {
    const bool is_list = field.kind == FieldKind::kTexts || AreWords(field);
    if (!field.is_option() || is_list) {
      const bool is_needed = field.place == ChangeField::Place::kWord;
      form.words.push_back({field.name, field.help, field.shown, is_needed});
      all.shown += (all.shown.empty() ? "" : " ") +
                   (field.kind == FieldKind::kTexts ? "[" + field.shown + " ...]" : field.shown);
    } else if (field.kind != FieldKind::kSettings) {
      form.options.push_back(OptionOf(field));
    }
    for (const ChangeField& each : field.known) form.options.push_back(OptionOf(each, false));
    if (is_list) all.most = 1000;
  }
  if (all.most > 1) form.words = {all};
  if (change.name == "delete") {
    form.options.push_back({"--yes", "yes", "also if it is the whole application, which ends its run"});
  }
  // As the command line has it: "connect /a/out /b/in --queue 10".
  form.example = form.name;
  std::istringstream words(change.example.substr(change.name.size()));
  for (std::string word; words >> word;) {
    if (std::ranges::count(change.fields, word, &ChangeField::word_before) > 0) continue;
    const auto option = std::ranges::find(form.options, word.substr(0, word.find('=')), &CommandOption::key);
    form.example += " " + (option == form.options.end() ? word : option->names + " " + word.substr(word.find('=') + 1));
  }
  return form;
}

}  // namespace

const std::vector<CommandForm>& ChangeCommands() {
  static const std::vector<CommandForm> all = [] {
    std::vector<CommandForm> forms;
    for (const ChangeForm& each : ChangeForms()) {
      if (!each.help.empty()) forms.push_back(CommandFormOf(each));
    }
    return forms;
  }();
  return all;
}

const ChangeForm* FindChangeCommand(std::string_view command, const std::vector<std::string>& words) {
  const std::string longer = std::string(command) + "_" + (words.empty() ? "" : words.front());
  const ChangeForm* form = nullptr;
  for (const ChangeForm& each : ChangeForms()) {
    if (each.name == longer) return &each;
    if (CommandOf(each) == command && !each.help.empty()) form = &each;
  }
  return form;
}

std::string ChangeTextOf(std::string_view command, const std::vector<std::string>& words,
                         const std::map<std::string, std::string>& options) {
  const ChangeForm* const form = FindChangeCommand(command, words);
  if (form == nullptr) return "";
  std::string text = form->name;
  auto word = words.begin();
  if (const std::size_t end = text.find('_'); end != std::string::npos) {
    text[end] = ' ';
    ++word;
  }
  for (const ChangeField& field : form->fields) {
    if (field.is_option()) break;
    if (!field.word_before.empty()) text += " " + field.word_before;
    if (word != words.end()) text += " " + AsArgument(*word++);
    while (field.kind == FieldKind::kTexts && word != words.end() && word->find('=') == std::string::npos) {
      text += " " + AsArgument(*word++);
    }
  }
  for (; word != words.end(); ++word) {
    const std::size_t equals = word->find('=');
    text += " " + (equals == std::string::npos ? AsArgument(*word)
                                               : word->substr(0, equals + 1) + AsArgument(word->substr(equals + 1)));
  }
  for (const auto& [name, value] : options) {
    if (name != "yes") text += " " + name + "=" + AsArgument(value);  // which the request says, not the change
  }
  return text;
}

}  // namespace runnel
