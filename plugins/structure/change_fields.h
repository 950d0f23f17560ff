#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "plugins/structure/change.h"

namespace runnel {

/// What a field says; nothing: it has not been said.
using FieldValue = std::variant<std::monostate, std::string, bool, std::uint64_t, Duration, std::vector<std::string>,
                                std::vector<Setting>>;

/// What a word names in an application, for who proposes words. kValue: of what the word before it names; kNewPath: below
/// a group; kPart: modules and groups.
enum class Proposal {
  kNothing,
  kPart,
  kModule,
  kNewPath,
  kDeletable,
  kSender,
  kReceiver,
  kParameter,
  kValue,
  kThread,
  kModuleType
};

/// One named part of a change, or of another request, as all clients have it.
struct FieldForm {
  /// kValue: any text, "" and numbers, too.
  enum class Kind { kText, kValue, kFlag, kCount, kNumber, kDuration, kTexts, kSettings };
  enum class Place { kWord, kOptionalWord, kOption };  ///< in the text format, and on the command line

  std::string name;          ///< in JSON, in requests: "on_full"
  std::string shown = {};    ///< in the place of its value, for people: "PATH", "N"
  std::string missing = {};  ///< of a word: what is missing without it, "a path"
  std::string help = {};
  Proposal proposal = Proposal::kNothing;
  Place place = Place::kWord;
  Kind kind = Kind::kText;
  std::string word_before = {};         ///< in the text format: "with"
  std::string text_name = {};           ///< of an option in the text format; "": as `name`
  std::vector<std::string> words = {};  ///< that can stand there; of a flag, those for no and yes. None: any
  std::uint64_t most = std::numeric_limits<std::uint64_t>::max();  ///< of a count; so many texts
  std::vector<FieldForm> known = {};  ///< of settings: those that have options of their own on the command line
  std::string flags = {};             ///< on the command line: "-l,--long"; "": by `name`
  bool is_required = false;           ///< of a request, by clients that say fields by name
  enum class For { kAll, kTerminal, kOthers } whom = For::kAll;

  std::function<FieldValue(const Change& change)> get = {};
  std::function<void(Change& change, FieldValue value)> set = {};

  [[nodiscard]] bool is_option() const { return place == Place::kOption; }
  [[nodiscard]] const std::string& option() const { return text_name.empty() ? name : text_name; }
};

/// One kind of change, as its readers and writers and the command line know it. What it means, change.h says; which role
/// clients need, the table of requests (plugins/command_service) says of "change".
struct ChangeForm {
  std::string name;                    ///< in JSON: "create_port"; in the text format "create port"
  std::string help = {};               ///< of its command on the terminal; "": it has none of its own
  std::string example = {};            ///< in the text format
  std::vector<FieldForm> fields = {};  ///< words, then options
  bool lets_move = true;               ///< whether something may move by it, and not only stop
  std::string command = {};            ///< on the terminal: "swap"; "": as `name`
  std::string words_help = {};         ///< of all words of the command, where their number is not fixed
  std::string usage_note = {};
  std::size_t kind = std::variant_size_v<Change> - 1;  ///< which alternative of Change
  std::function<Change()> make = {};
  /// What is wrong with fields that are good by themselves, and with which; `is_said`: whether it has been given.
  using IsSaid = std::function<bool(std::string_view field)>;
  std::function<std::optional<std::pair<std::string, Error>>(const Change& change, const IsSaid& is_said)> check = {};
};

/// All kinds of changes. Static.
[[nodiscard]] const std::vector<ChangeForm>& ChangeForms();
/// By its name in JSON. Errors: there is no such change, with the nearest name.
[[nodiscard]] Result<const ChangeForm*> FindChangeForm(std::string_view name);
/// nullptr: of an extension that nobody knows.
[[nodiscard]] const ChangeForm* FormOf(const Change& change);

}  // namespace runnel
