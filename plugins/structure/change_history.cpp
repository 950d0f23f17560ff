#include "plugins/structure/change_history.h"

#include <utility>

#include "core/base/characters.h"
#include "core/base/error.h"
#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

constexpr std::size_t kLongestLabel = 200;

std::string LabelOf(const ChangeSet& changes) {
  if (changes.empty()) return "nothing";
  std::string label = Shortened(ChangeText(changes.front()), kLongestLabel);
  if (changes.size() == 1) return label;
  return label + " and " + std::to_string(changes.size() - 1) + " more";
}

ChangeOutcome NotDone(Error error, bool is_refused) {
  ChangeOutcome outcome;
  outcome.is_refused = is_refused;
  outcome.diagnostics.Add(std::move(error));
  return outcome;
}

}  // namespace

ChangeOutcome ChangeHistory::Apply(const ChangeSet& changes, const std::vector<SourcePosition>& places,
                                   std::string label, std::string client, const RobotStop::AsOf& as_of) {
  const std::lock_guard one_after_the_other(applying_);
  Entries entry;
  try {
    entry.push_back({label.empty() ? LabelOf(changes) : std::move(label), std::move(client), {}});
  } catch (...) {
    return NotDone({.message = DescribeException()}, false);
  }
  ChangeOutcome outcome = editor_.Apply({changes, places, as_of, nullptr, &entry.back().undo_record});
  if (!outcome.is_done || changes.empty()) return outcome;
  const std::lock_guard lock(entries_);
  undone_.clear();
  Add(done_, entry);
  return outcome;
}

ChangeOutcome ChangeHistory::Take(Entries& from, Entries& to, const char* what, const RobotStop::AsOf& as_of) {
  const std::lock_guard one_after_the_other(applying_);
  try {
    Entries back;
    Entry entry;
    {
      const std::lock_guard lock(entries_);
      if (from.empty()) return NotDone({.message = "there is nothing to be " + std::string(what)}, true);
      entry = from.back();
    }
    back.push_back({entry.label, entry.client, {}});
    ChangeOutcome outcome =
        entry.undo_record.why_not
            ? NotDone(*entry.undo_record.why_not, true)
            : editor_.Apply({entry.undo_record.changes, {}, as_of, &entry.undo_record, &back.back().undo_record});
    if (!outcome.is_done && outcome.is_refused) {
      outcome.diagnostics.Add({.message = "'" + entry.label + "' can no longer be " + what + ", and is forgotten"});
    }
    const std::lock_guard lock(entries_);
    if (outcome.is_done || outcome.is_refused) from.pop_back();
    if (outcome.is_done) Add(to, back);
    return outcome;
  } catch (...) {
    return NotDone({.message = DescribeException()}, false);
  }
}

// `entry` is one.
void ChangeHistory::Add(Entries& to, Entries& entry) {
  to.splice(to.end(), entry);
  if (to.size() > most_entries_) to.pop_front();
}

std::optional<std::string> ChangeHistory::LastOf(const Entries& entries, std::string Entry::*part) const {
  const std::lock_guard lock(entries_);
  return entries.empty() ? std::nullopt : std::optional(entries.back().*part);
}

}  // namespace runnel
