// Changes as the text that ParseChanges() reads.

#include "core/types/duration_text.h"
#include "core/types/text_format.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/change_arguments.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

using internal::AsArgument;

std::string SettingsText(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& each : settings) text += " " + each.parameter + "=" + AsArgument(each.value);
  return text;
}

std::string Text(const CreateModule& change) {
  // Relative paths and absolute ones are the same; these would be taken for the other arguments.
  const bool is_keyword =
      change.path == "group" || change.path == "port" || change.path == "parameter" || change.path == "thread";
  return std::string("create ") + (is_keyword ? "/" : "") + AsArgument(change.path) + " " + AsArgument(change.type) +
         SettingsText(change.settings);
}
std::string Text(const CreateGroup& change) { return "create group " + AsArgument(change.path); }
std::string Text(const CreatePort& change) {
  const bool is_input = change.direction == Port::Direction::kInput;
  return "create port " + AsArgument(change.path) + " " + (is_input ? "input" : "output") + " " +
         AsArgument(change.type) + (change.description.empty() ? "" : " description=" + AsArgument(change.description));
}
std::string Text(const CreateParameter& change) {
  std::string text = "create parameter " + AsArgument(change.path);
  for (const std::string& target : change.targets) text += " " + AsArgument(target);
  return text + (change.description.empty() ? "" : " description=" + AsArgument(change.description));
}
std::string Text(const DeleteElement& change) { return "delete " + AsArgument(change.path); }
std::string Text(const ConnectPorts& change) {
  const ConnectOptions& options = change.options;
  const bool has_dot = !options.part.empty() && options.part.front() != '[';
  std::string text =
      "connect " + AsArgument(change.from + (has_dot ? "." : "") + options.part) + " " + AsArgument(change.to);
  if (options.pull) text += " pull=true";
  if (!options.convert.empty()) text += " convert=" + AsArgument(options.convert);
  if (options.when_present) text += " when=present";
  if (options.late) text += " late=true";
  if (change.options.queue == 0) return text;
  text += " queue=" + std::to_string(change.options.queue);
  if (change.options.on_full == OnFull::kDropOldest) return text;
  return text + " on_full=" + OnFullNames()[static_cast<std::size_t>(change.options.on_full)];
}
std::string Text(const DisconnectPorts& change) {
  return "disconnect " + AsArgument(change.from) + " " + AsArgument(change.to);
}
std::string Text(const SetParameter& change) {
  return "set " + AsArgument(change.path) + " " +
         AsArgument(change.object ? ToText(*change.type, change.object.get()) : change.value);
}
std::string Text(const ReplaceModule& change) {
  std::string text =
      "replace " + AsArgument(change.path) + " with " + AsArgument(change.type) + SettingsText(change.settings);
  if (change.probation_cycles == ReplaceModule{}.probation_cycles) return text;
  return text + " probation=" + std::to_string(change.probation_cycles);
}
std::string Text(const RenameElement& change) {
  return "rename " + AsArgument(change.path) + " " + AsArgument(change.name);
}
std::string Text(const CopyElement& change) {
  return "copy " + AsArgument(change.path) + (change.name.empty() ? "" : " " + AsArgument(change.name));
}
std::string Text(const AssignToThread& change) {
  return "move " + AsArgument(change.path) + " to " + AsArgument(change.thread);
}

std::string Text(const LogElement& change) {
  return "log " + AsArgument(change.path) + " " + (change.level ? LogLevelName(*change.level) : "inherit");
}
std::string Text(const TagElement& change) {
  std::string text = "tag " + AsArgument(change.path);
  for (const std::string& tag : change.tags) text += " " + AsArgument(tag);
  return text;
}

std::string Text(const ExtensionChange& change) {
  std::string text = change.verb;
  for (const std::string& word : change.words) text += " " + AsArgument(word);
  return text + SettingsText(change.settings);
}

std::string OverrunText(ThreadOptions::OnOverrun on_overrun) {
  return " on_overrun=" + OverrunNames()[static_cast<std::size_t>(on_overrun)];
}
std::string ActivationOption(ThreadOptions::Activation activation) {
  return " activation=" + ActivationNames()[static_cast<std::size_t>(activation)];
}
std::string Text(const AddThread& change) {
  const ThreadOptions& options = change.options;
  std::string text = "create thread " + AsArgument(change.name);
  if (options.activation != ThreadOptions::Activation::kPeriod) {
    text += ActivationOption(options.activation);
  }
  if (options.activation != ThreadOptions::Activation::kTrigger) {
    text += " period=" + DurationText(options.period);
  }
  if (options.priority != 0) text += " priority=" + std::to_string(options.priority);
  const bool skips = options.on_overrun == ThreadOptions::OnOverrun::kSkip;
  return text + (skips ? "" : OverrunText(options.on_overrun));
}
std::string Text(const ScheduleThread& change) {
  std::string text = "schedule " + AsArgument(change.thread);
  if (change.activation) text += ActivationOption(*change.activation);
  if (change.period) text += " period=" + DurationText(*change.period);
  if (change.priority) text += " priority=" + std::to_string(*change.priority);
  return text + (change.on_overrun ? OverrunText(*change.on_overrun) : "");
}

}  // namespace

std::string ChangeText(const Change& change) {
  return std::visit([](const auto& each) { return Text(each); }, change);
}

}  // namespace runnel
