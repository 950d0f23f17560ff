#include "plugins/structure/change_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "core/base/nearest_name.h"
#include "plugins/structure/change_words.h"

namespace runnel {

namespace {

using internal::AsWord;
using internal::ChangeLine;
using internal::ChangeWord;

constexpr std::size_t kLongestQueue = 1'000'000;
constexpr std::uint64_t kLongestProbation = 1'000'000'000;
const std::vector<std::string> kOnFullNames{"drop_oldest", "drop_newest", "refuse"};
const std::vector<std::string> kDirections{"input", "output"};

Error At(const SourcePosition& position, std::string message, std::string hint) {
  return {.message = std::move(message), .position = position, .hint = std::move(hint)};
}

// The words of one change, taken one after the other. What is missing or wrong is remembered, the first
// of it, so that readers read straight on.
class Words {
 public:
  Words(const ChangeLine& line, std::string usage) : line_(line), usage_(std::move(usage)) {}

  std::string Take(const char* what) {
    if (at_ < line_.size()) return line_[at_++].text;
    const ChangeWord& last = line_.back();
    Complain(last.position, std::string(what) + " is missing after '" + last.text + "'",
             "write: " + usage_);
    return {};
  }
  [[nodiscard]] bool IsNext(std::string_view text) const {
    return at_ < line_.size() && line_[at_].text == text;
  }
  void Expect(const std::string& text) {
    const ChangeWord* word = at_ < line_.size() ? &line_[at_] : nullptr;
    const std::string found = Take(("'" + text + "'").c_str());
    if (word != nullptr && found != text) {
      Complain(word->position, "there should be '" + text + "' instead of '" + found + "'",
               "write: " + usage_);
    }
  }
  std::size_t TakeOneOf(const char* what, const std::vector<std::string>& names) {
    const ChangeWord* word = at_ < line_.size() ? &line_[at_] : nullptr;
    const std::string found = Take(what);
    return word != nullptr ? Choose(*word, found, names) : 0;
  }
  /// The rest, all "name=value", goes to `take`, which says whether it has been interested.
  template <typename TakeOption>
  void TakeOptions(const std::vector<std::string>& names, const TakeOption& take) {
    std::vector<std::string> seen;
    for (; at_ < line_.size(); ++at_) {
      const ChangeWord& word = line_[at_];
      if (!word.equals || *word.equals == 0) {
        Complain(word.position, "'" + word.text + "' is one word too many", "write: " + usage_);
      } else if (std::ranges::count(seen, word.name()) > 0) {
        Complain(NameAt(word), "'" + word.name() + "' is there twice", "leave one of them out");
      } else if (!take(word)) {
        Complain(NameAt(word), "there is no option '" + word.name() + "'",
                 NearestNameHint(word.name(), names));
      }
      seen.push_back(word.name());
    }
  }
  void End() {
    TakeOptions({}, [](const ChangeWord&) { return false; });
  }

  std::size_t Choose(const ChangeWord& word, const std::string& value,
                     const std::vector<std::string>& names) {
    const auto found = std::ranges::find(names, value);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    Complain(word.position, "'" + value + "' is none of the words that can stand here",
             NearestNameHint(value, names));
    return 0;
  }
  template <typename Number>
  Number ReadCount(const ChangeWord& word, Number largest) {
    const std::string text = word.value();
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size() && number <= largest) {
      return number;
    }
    Complain(word.position, "'" + text + "' is not a count for '" + word.name() + "'",
             "write a whole number from 0 to " + std::to_string(largest));
    return {};
  }
  void Complain(const SourcePosition& position, std::string message, std::string hint) {
    if (!error_) error_ = At(position, std::move(message), std::move(hint));
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  static const SourcePosition& NameAt(const ChangeWord& word) { return word.position; }

  const ChangeLine& line_;
  const std::string usage_;
  std::size_t at_ = 1;
  std::optional<Error> error_;
};

std::vector<Setting> TakeSettings(Words& words) {
  std::vector<Setting> settings;
  words.TakeOptions({}, [&](const ChangeWord& word) {
    settings.push_back({word.name(), word.value()});
    return true;
  });
  return settings;
}

Change ReadCreate(Words& words) {
  if (words.IsNext("group")) {
    words.Take("group");
    CreateGroup change{words.Take("a path")};
    words.End();
    return change;
  }
  if (words.IsNext("port")) {
    words.Take("port");
    CreatePort change{.path = words.Take("a path"), .type = {}};
    change.direction = words.TakeOneOf("'input' or 'output'", kDirections) == 0
                           ? Port::Direction::kInput
                           : Port::Direction::kOutput;
    change.type = words.Take("a data type");
    words.TakeOptions({"description"}, [&](const ChangeWord& word) {
      if (word.name() == "description") change.description = word.value();
      return word.name() == "description";
    });
    return change;
  }
  CreateModule change{words.Take("a path"), {}};
  change.type = words.Take("a module type");
  change.settings = TakeSettings(words);
  return change;
}

Change ReadDelete(Words& words) {
  DeleteElement change{words.Take("a path")};
  words.End();
  return change;
}

Change ReadConnect(Words& words) {
  ConnectPorts change{words.Take("the output"), {}};
  change.to = words.Take("the input");
  const ChangeWord* on_full = nullptr;
  words.TakeOptions({"queue", "on_full"}, [&](const ChangeWord& word) {
    if (word.name() == "queue") {
      change.options.queue = words.ReadCount<std::size_t>(word, kLongestQueue);
    } else if (word.name() == "on_full") {
      on_full = &word;
      change.options.on_full = static_cast<OnFull>(words.Choose(word, word.value(), kOnFullNames));
    } else {
      return false;
    }
    return true;
  });
  if (on_full != nullptr && change.options.queue == 0) {
    words.Complain(on_full->position, "on_full has no meaning without a queue",
                   "add queue=N with a count above 0, or leave out on_full");
  }
  return change;
}

Change ReadDisconnect(Words& words) {
  DisconnectPorts change{words.Take("the output"), {}};
  change.to = words.Take("the input");
  words.End();
  return change;
}

Change ReadSet(Words& words) {
  SetParameter change{words.Take("the path of a parameter"), {}};
  change.value = words.Take("a value");
  words.End();
  return change;
}

Change ReadReplace(Words& words) {
  ReplaceModule change{words.Take("the path of a module"), {}};
  words.Expect("with");
  change.type = words.Take("a module type");
  words.TakeOptions({}, [&](const ChangeWord& word) {
    if (word.name() == "probation") {
      change.probation_cycles = words.ReadCount<std::uint64_t>(word, kLongestProbation);
    } else {
      change.settings.push_back({word.name(), word.value()});
    }
    return true;
  });
  return change;
}

Change ReadMove(Words& words) {
  AssignToThread change{words.Take("a path"), {}};
  words.Expect("to");
  change.thread = words.Take("a thread");
  words.End();
  return change;
}

struct Verb {
  const char* name;
  const char* usage;
  Change (*read)(Words& words);
};
constexpr std::array<Verb, 7> kVerbs{{
    {"create",
     "create [group] PATH TYPE [NAME=VALUE ...], or create port PATH input|output TYPE "
     "[description=TEXT]",
     ReadCreate},
    {"delete", "delete PATH", ReadDelete},
    {"connect", "connect FROM TO [queue=N] [on_full=drop_oldest|drop_newest|refuse]", ReadConnect},
    {"disconnect", "disconnect FROM TO", ReadDisconnect},
    {"set", "set PATH VALUE, with a VALUE that has blanks in quotation marks", ReadSet},
    {"replace", "replace PATH with TYPE [NAME=VALUE ...] [probation=CYCLES]", ReadReplace},
    {"move", "move PATH to THREAD", ReadMove},
}};

Result<Change> ReadChange(const ChangeLine& line) {
  const ChangeWord& first = line.front();
  const auto verb = std::ranges::find(kVerbs, first.text, &Verb::name);
  if (verb == kVerbs.end()) {
    std::vector<std::string> names;
    for (const Verb& each : kVerbs) names.emplace_back(each.name);
    return At(first.position, "there is no change '" + first.text + "'",
              NearestNameHint(first.text, names));
  }
  Words words(line, verb->usage);
  Change change = verb->read(words);
  if (words.error()) return *words.error();
  return change;
}

std::string SettingsText(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& each : settings) text += " " + each.parameter + "=" + AsWord(each.value);
  return text;
}

std::string Text(const CreateModule& change) {
  // Relative paths and absolute ones are the same; these two would be taken for the other words.
  const bool is_word = change.path == "group" || change.path == "port";
  return std::string("create ") + (is_word ? "/" : "") + AsWord(change.path) + " " +
         AsWord(change.type) + SettingsText(change.settings);
}
std::string Text(const CreateGroup& change) { return "create group " + AsWord(change.path); }
std::string Text(const CreatePort& change) {
  const bool is_input = change.direction == Port::Direction::kInput;
  return "create port " + AsWord(change.path) + " " + kDirections[is_input ? 0 : 1] + " " +
         AsWord(change.type) +
         (change.description.empty() ? "" : " description=" + AsWord(change.description));
}
std::string Text(const DeleteElement& change) { return "delete " + AsWord(change.path); }
std::string Text(const ConnectPorts& change) {
  std::string text = "connect " + AsWord(change.from) + " " + AsWord(change.to);
  if (change.options.queue == 0) return text;
  text += " queue=" + std::to_string(change.options.queue);
  if (change.options.on_full == OnFull::kDropOldest) return text;
  return text + " on_full=" + kOnFullNames[static_cast<std::size_t>(change.options.on_full)];
}
std::string Text(const DisconnectPorts& change) {
  return "disconnect " + AsWord(change.from) + " " + AsWord(change.to);
}
std::string Text(const SetParameter& change) {
  return "set " + AsWord(change.path) + " " + AsWord(change.value);
}
std::string Text(const ReplaceModule& change) {
  std::string text = "replace " + AsWord(change.path) + " with " + AsWord(change.type) +
                     SettingsText(change.settings);
  if (change.probation_cycles == ReplaceModule{}.probation_cycles) return text;
  return text + " probation=" + std::to_string(change.probation_cycles);
}
std::string Text(const AssignToThread& change) {
  return "move " + AsWord(change.path) + " to " + AsWord(change.thread);
}

}  // namespace

PlacedChanges ParseChanges(std::string_view text, const SourcePosition& begins,
                           Diagnostics& diagnostics) {
  PlacedChanges placed;
  for (const ChangeLine& line : internal::SplitChanges(text, begins, diagnostics)) {
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
  return std::visit([](const auto& each) { return Text(each); }, change);
}

}  // namespace runnel
