#include "plugins/structure/change_text.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/argument_text.h"
#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "core/types/duration_text.h"
#include "plugins/structure/change_fields.h"

namespace runnel {

namespace {

using internal::ArgumentLine;
using internal::AsArgument;
using internal::TextArgument;
using FieldKind = FieldForm::Kind;

// "create port" of "create_port"
std::string VerbOf(const ChangeForm& form) {
  std::string verb = form.name;
  std::ranges::replace(verb, '_', ' ');
  return verb;
}

// "PATH", "input|output", "[WORD ...]", "[queue=N]", "[pull=true]"
std::string UsageOf(const FieldForm& field) {
  std::string value = field.kind == FieldKind::kFlag ? field.words[1] : field.shown;
  if (field.kind == FieldKind::kText && !field.words.empty()) {
    value = field.words.front();
    for (auto each = field.words.begin() + 1; each != field.words.end(); ++each) value += "|" + *each;
  }
  if (field.kind == FieldKind::kTexts || field.kind == FieldKind::kSettings) value += " ...";
  if (field.is_option() && field.kind != FieldKind::kSettings) value = field.option() + "=" + value;
  if (field.place != FieldForm::Place::kWord) value = "[" + value + "]";
  return field.word_before.empty() ? value : field.word_before + " " + value;
}

// "create port PATH input|output TYPE [description=TEXT]"
std::string UsageOf(const ChangeForm& form) {
  std::string usage = VerbOf(form);
  for (const FieldForm& field : form.fields) usage += " " + UsageOf(field);
  return usage + form.usage_note;
}

// "create port …", "create …": the longest of the verbs with which a line begins. nullptr: none.
const ChangeForm* FormOf(const std::string& first, const std::string& second) {
  const auto find = [](const std::string& name) {
    const auto found = std::ranges::find(ChangeForms(), name, &ChangeForm::name);
    return found != ChangeForms().end() ? &*found : nullptr;
  };
  const ChangeForm* const longer = find(first + "_" + second);
  return longer != nullptr || first.find('_') != std::string::npos ? longer : find(first);
}

Error ErrorAt(const SourcePosition& position, std::string message, std::string hint) {
  return {.message = std::move(message), .position = position, .hint = std::move(hint)};
}

// A text that is no list.
Result<FieldValue> ReadValue(const FieldForm& field, const std::string& text, const SourcePosition& position) {
  if (field.kind == FieldKind::kDuration) {
    const auto duration = ParseDuration(text);
    return duration ? Result<FieldValue>(*duration)
                    : ErrorAt(position, duration.error().message, duration.error().hint);
  }
  if (field.kind == FieldKind::kCount) {
    const auto number = NumberIn<std::uint64_t>(text);
    if (number && *number <= field.most) return FieldValue(*number);
    return ErrorAt(position, "'" + text + "' is not a count for '" + field.name + "'",
                   "write a whole number from 0 to " + std::to_string(field.most));
  }
  const auto found = std::ranges::find(field.words, text);
  if (!field.words.empty() && (found == field.words.end() || found->empty())) {
    std::vector<std::string> words = field.words;
    std::erase(words, "");
    return ErrorAt(position, "'" + text + "' is none of the words that can stand here", NearestNameHint(text, words));
  }
  return field.kind == FieldKind::kFlag ? FieldValue(found != field.words.begin()) : FieldValue(text);
}

// One change, argument by argument. The line must outlive it, and begin with the verb of the form.
class LineReading {
 public:
  LineReading(const ChangeForm& form, const ArgumentLine& line)
      : form_(form), line_(line), at_(form.name.find('_') == std::string::npos ? 1 : 2), change_(form.make()) {}

  Result<Change> Read() {
    for (const FieldForm& field : form_.fields) {
      auto read = field.is_option() ? Result<void>() : ReadWord(field);
      if (!read) return read.error();
    }
    for (; at_ < line_.size(); ++at_) {
      if (auto read = ReadOption(line_[at_]); !read) return read.error();
    }
    const auto conflict =
        form_.check ? form_.check(change_, [&](auto field) { return PlaceOf(field) != nullptr; }) : std::nullopt;
    if (!conflict) return std::move(change_);
    return ErrorAt(PlaceOf(conflict->first)->position, conflict->second.message, conflict->second.hint);
  }

 private:
  [[nodiscard]] Error Wrong(const TextArgument& argument, std::string message) const {
    return ErrorAt(argument.position, std::move(message), "write: " + UsageOf(form_));
  }
  Result<const TextArgument*> Take(const std::string& missing) {
    if (at_ < line_.size()) return &line_[at_++];
    return Wrong(line_.back(), missing + " is missing after '" + line_.back().text + "'");
  }
  Result<void> ReadWord(const FieldForm& field) {
    if (!field.word_before.empty()) {
      const auto word = Take("'" + field.word_before + "'");
      if (!word) return word.error();
      if ((*word)->text != field.word_before) {
        return Wrong(**word, "there should be '" + field.word_before + "' instead of '" + (*word)->text + "'");
      }
    }
    if (at_ == line_.size() && field.place == FieldForm::Place::kOptionalWord) return {};
    const auto word = Take(field.missing);
    if (!word) return word.error();
    if (field.kind != FieldKind::kTexts) return Set(field, (*word)->text, **word);
    std::vector<std::string> texts{(*word)->text};
    for (; at_ < line_.size() && !line_[at_].equals; ++at_) texts.push_back(line_[at_].text);
    field.set(change_, std::move(texts));
    return {};
  }
  Result<void> ReadOption(const TextArgument& argument) {
    const std::string name = argument.name();
    if (!argument.equals || name.empty()) {
      return Wrong(argument, "'" + argument.text + "' is one word too many");
    }
    if (!places_.emplace(name, &argument).second) {
      return ErrorAt(argument.position, "'" + name + "' is there twice", "leave one of them out");
    }
    std::vector<std::string> names;
    const FieldForm* all = nullptr;
    for (const FieldForm& field : form_.fields) {
      if (!field.is_option()) continue;
      if (field.kind == FieldKind::kSettings) {
        all = &field;
      } else if (field.option() == name) {
        return Set(field, argument.value(), argument);
      } else {
        names.push_back(field.option());
      }
    }
    if (all == nullptr) {
      return ErrorAt(argument.position, "there is no option '" + name + "'", NearestNameHint(name, names));
    }
    auto settings = std::get<std::vector<Setting>>(all->get(change_));
    settings.push_back({name, argument.value()});
    all->set(change_, std::move(settings));
    return {};
  }
  Result<void> Set(const FieldForm& field, const std::string& text, const TextArgument& argument) {
    auto value = ReadValue(field, text, argument.position);
    if (!value) return value.error();
    field.set(change_, std::move(*value));
    return {};
  }
  [[nodiscard]] const TextArgument* PlaceOf(std::string_view option) const {
    const auto found = places_.find(option);
    return found != places_.end() ? found->second : nullptr;
  }

  const ChangeForm& form_;
  const ArgumentLine& line_;
  std::size_t at_;
  Change change_;
  std::map<std::string, const TextArgument*, std::less<>> places_;
};

Result<Change> ReadChange(const ArgumentLine& line) {
  const std::string& first = line.front().text;
  const ChangeForm* const form = FormOf(first, line.size() > 1 ? line[1].text : "");
  if (form != nullptr) return LineReading(*form, line).Read();
  std::vector<std::string> verbs = NamesOf(ChangeForms(), &ChangeForm::name);
  std::erase_if(verbs, [](const std::string& each) { return each.find('_') != std::string::npos; });
  return ErrorAt(line.front().position, "there is no change '" + first + "'", NearestNameHint(first, verbs));
}

std::string TextOf(const FieldForm& field, const FieldValue& value) {
  if (const auto* const text = std::get_if<std::string>(&value)) return AsArgument(*text);
  if (const auto* const count = std::get_if<std::uint64_t>(&value)) return std::to_string(*count);
  if (const auto* const duration = std::get_if<Duration>(&value)) return DurationText(*duration);
  if (const auto* const flag = std::get_if<bool>(&value)) return field.words[*flag ? 1 : 0];
  return "";
}

// With a blank before each word.
std::string WordsOf(const FieldForm& field, const FieldValue& value, bool is_usual) {
  std::string text = field.word_before.empty() ? "" : " " + field.word_before;
  if (const auto* const texts = std::get_if<std::vector<std::string>>(&value)) {
    for (const std::string& each : *texts) text += " " + AsArgument(each);
  } else if (const auto* const settings = std::get_if<std::vector<Setting>>(&value)) {
    for (const Setting& each : *settings) text += " " + each.parameter + "=" + AsArgument(each.value);
  } else if (field.place == FieldForm::Place::kWord) {
    text += " " + TextOf(field, value);
  } else if (!is_usual) {
    text += " " + (field.is_option() ? field.option() + "=" : "") + TextOf(field, value);
  }
  return text;
}

}  // namespace

PlacedChanges ParseChanges(std::string_view text, const SourcePosition& begins, Diagnostics& diagnostics) {
  PlacedChanges placed;
  for (const ArgumentLine& line : internal::SplitArguments(text, begins, diagnostics)) {
    auto change = ReadChange(line);
    if (!change) {
      diagnostics.Add(change.error());
      continue;
    }
    placed.changes.push_back(std::move(*change));
    placed.positions.push_back(line.front().position);
  }
  return placed;
}

std::string ChangeText(const Change& change) {
  const ChangeForm* const form = FormOf(change);
  if (form == nullptr) return std::get<ExtensionChange>(change).verb;  // which nobody reads, nor carries out
  const std::string verb = VerbOf(*form);
  const Change usual = form->make();
  std::string words;
  for (const FieldForm& field : form->fields) {
    const FieldValue value = field.get(change);
    words += WordsOf(field, value, value == field.get(usual));
  }
  // Relative paths and absolute ones are the same; a module that is called "group" would be taken for one.
  const bool is_verb = verb == form->name && FormOf(verb, words.substr(1, words.find(' ', 1) - 1)) != form;
  return verb + (is_verb ? words.insert(1, "/") : words);
}

}  // namespace runnel
