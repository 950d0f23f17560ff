#include "plugins/structure/change_history.h"

#include <utility>

#include "plugins/structure/change_text.h"

namespace runnel {

namespace {

constexpr std::size_t kLongestLabel = 200;

std::string LabelOf(const ChangeSet& changes) {
  if (changes.empty()) return "nothing";
  std::string label = ChangeText(changes.front());
  if (label.size() > kLongestLabel) label = label.substr(0, kLongestLabel) + " …";
  if (changes.size() == 1) return label;
  return label + " and " + std::to_string(changes.size() - 1) + " more";
}

ChangeOutcome Refused(Error error) {
  ChangeOutcome outcome;
  outcome.is_refused = true;
  outcome.diagnostics.Add(std::move(error));
  return outcome;
}

}  // namespace

ChangeOutcome ChangeHistory::Apply(const ChangeSet& changes,
                                   const std::vector<SourcePosition>& places, std::string label) {
  const std::lock_guard one_after_the_other(applying_);
  Entry entry{label.empty() ? LabelOf(changes) : std::move(label), {}};
  ChangeOutcome outcome = editor_.Apply({changes, places, nullptr, &entry.taking});
  if (!outcome || changes.empty()) return outcome;
  const std::lock_guard lock(entries_);
  undone_.clear();
  Add(done_, std::move(entry));
  return outcome;
}

ChangeOutcome ChangeHistory::Undo() { return Take(done_, undone_, "undone"); }

ChangeOutcome ChangeHistory::Redo() { return Take(undone_, done_, "redone"); }

// What takes back what took back is what was done.
ChangeOutcome ChangeHistory::Take(Entries& from, Entries& to, const char* what) {
  const std::lock_guard one_after_the_other(applying_);
  Entry entry;
  {
    const std::lock_guard lock(entries_);
    if (from.empty()) return Refused({.message = "there is nothing to be " + std::string(what)});
    entry = from.back();
  }
  Entry back{entry.label, {}};
  ChangeOutcome outcome =
      entry.taking.why_not ? Refused(*entry.taking.why_not)
                           : editor_.Apply({entry.taking.changes, {}, &entry.taking, &back.taking});
  const std::lock_guard lock(entries_);
  if (outcome) {
    from.pop_back();
    Add(to, std::move(back));
  } else if (outcome.is_refused) {
    from.pop_back();
    outcome.diagnostics.Add(
        {.message = "'" + entry.label + "' can no longer be " + what + ", and is forgotten"});
  }
  return outcome;
}

void ChangeHistory::Add(Entries& to, Entry entry) {
  to.push_back(std::move(entry));
  if (to.size() > most_entries_) to.pop_front();
}

std::optional<std::string> ChangeHistory::NextUndo() const {
  const std::lock_guard lock(entries_);
  return done_.empty() ? std::nullopt : std::optional(done_.back().label);
}

std::optional<std::string> ChangeHistory::NextRedo() const {
  const std::lock_guard lock(entries_);
  return undone_.empty() ? std::nullopt : std::optional(undone_.back().label);
}

}  // namespace runnel
