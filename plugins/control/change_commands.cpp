#include "plugins/control/change_commands.h"

#include <algorithm>
#include <sstream>

#include "core/base/argument_text.h"

namespace runnel {

namespace {

using internal::AsArgument;
using FieldKind = FieldForm::Kind;

const std::string& CommandOf(const ChangeForm& form) { return form.command.empty() ? form.name : form.command; }

// As the command line has it: "connect /a/out /b/in --queue 10".
std::string ExampleOf(const ChangeForm& change, const std::vector<FieldForm>& fields) {
  std::string example = CommandOf(change);
  std::istringstream words(change.example.substr(change.name.size()));
  for (std::string word; words >> word;) {
    const std::string name = word.substr(0, word.find('='));
    if (std::ranges::count(change.fields, word, &FieldForm::word_before) > 0) continue;
    const bool is_option = name != word && std::ranges::count(fields, name, &FieldForm::name) > 0;
    example += is_option ? " --" + name + " " + word.substr(name.size() + 1) : " " + word;
  }
  return example;
}

// Where a change takes any number of words, the command takes all of them as one list; settings of any name are words.
CommandForm CommandFormOf(const ChangeForm& change) {
  FieldForm all{.name = "words", .help = change.words_help, .kind = FieldKind::kTexts};
  std::vector<FieldForm> words, options;
  for (const FieldForm& field : change.fields) {
    options.insert(options.end(), field.known.begin(), field.known.end());
    const bool is_option = field.is_option() && field.kind != FieldKind::kSettings;
    if (is_option || field.known.empty()) (is_option ? options : words).push_back(field);
    if (is_option || !field.known.empty()) continue;
    all.shown +=
        (all.shown.empty() ? "" : " ") + (field.kind == FieldKind::kTexts ? "[" + field.shown + " ...]" : field.shown);
  }
  if (!change.words_help.empty()) words = {all};
  words.insert(words.end(), options.begin(), options.end());
  if (change.name == "delete") {
    words.push_back({.name = "yes",
                     .help = "also if it is the whole application, which ends its run",
                     .place = FieldForm::Place::kOption,
                     .kind = FieldKind::kFlag,
                     .words = {"", "yes"}});
  }
  return {CommandOf(change), "Changing it", "", change.lets_move, change.help, ExampleOf(change, options), words};
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
  for (const FieldForm& field : form->fields) {
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
