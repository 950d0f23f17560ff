#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "plugins/structure/change_history.h"

namespace runnel::test {

/// Paths of the ports that have to be marked as driving, and of those that have to be blocked, whatever the ports themselves say.
/// What a change takes away comes back with all that it was when the change is taken back.
class ExpectedMarks {
 public:
  using Paths = std::set<std::string>;
  Paths marked, blocked;
  std::uint64_t came_back = 0;  ///< marks and blocks

  /// A change has been done; `from`, `to`: of a rename, else "". `there`: the paths of all ports now.
  void Did(const std::string& label, const std::string& from, const std::string& to, const Paths& there) {
    Move(from, to);
    done_.push_back({label, from, to, {}, {}});
    Exchange(done_.back(), there);
    if (done_.size() > ChangeHistory::kMostEntries) done_.erase(done_.begin());
    undone_.clear();
  }
  /// The last one has been taken back, or done again; or it could not be, and has been forgotten.
  void Undid(bool is_done, const Paths& there) { Take(done_, undone_, is_done, there); }
  void Redid(bool is_done, const Paths& there) { Take(undone_, done_, is_done, there); }
  [[nodiscard]] std::optional<std::string> NextUndo() const { return LabelOf(done_); }
  [[nodiscard]] std::optional<std::string> NextRedo() const { return LabelOf(undone_); }

 private:
  struct Entry {
    std::string label, from, to;
    Paths marked, blocked;  // of what is away because of it
  };

  static std::optional<std::string> LabelOf(const std::vector<Entry>& entries) {
    return entries.empty() ? std::nullopt : std::optional(entries.back().label);
  }
  void Take(std::vector<Entry>& entries, std::vector<Entry>& others, bool is_done, const Paths& there) {
    Entry entry = std::move(entries.back());
    entries.pop_back();
    if (!is_done) return;
    Move(entry.to, entry.from);
    std::swap(entry.from, entry.to);
    Exchange(entry, there);
    others.push_back(std::move(entry));
  }
  void Move(const std::string& from, const std::string& to) {
    if (from.empty()) return;
    for (Paths* const paths : {&marked, &blocked}) {
      Paths moved;
      for (const std::string& path : *paths)
        moved.insert(path.starts_with(from + "/") ? to + path.substr(from.size()) : path);
      *paths = std::move(moved);
    }
  }
  // What has gone by the change waits in the entry; what waited there has come back.
  void Exchange(Entry& entry, const Paths& there) {
    const auto exchange = [&](Paths& paths, Paths& waiting) {
      Paths gone;
      for (const std::string& path : paths) {
        if (!there.contains(path)) gone.insert(path);
      }
      std::erase_if(paths, [&](const std::string& path) { return gone.contains(path); });
      came_back += waiting.size();
      paths.merge(waiting);
      waiting = std::move(gone);
    };
    exchange(marked, entry.marked);
    exchange(blocked, entry.blocked);
  }

  std::vector<Entry> done_, undone_;  // as the history has them
};

}  // namespace runnel::test
