#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/paths/path_search.h"
#include "plugins/structure/change.h"

namespace runnel {

/// A change of an extension that has been found possible.
struct ExtensionStep {
  /// Other changes that it comes to, carried out before it.
  ChangeSet changes = {};
  // As of the steps of a plan; without `apply` there is none.
  std::function<Result<void>()> apply = {};
  std::function<void()> undo = {};
  std::function<ChangeSet()> inverse = {};  ///< asked right before apply()
};

/// The changes that extensions bring, by their verbs: kept with the root of the tree.
///
/// Threads: under the structure lock.
struct ExtensionChanges final : Annotation {
  /// The port at a path, as it will be when the changes before have been made.
  using Find = std::function<Result<Port*>(const std::string& path, PathKind kind)>;
  using Check = std::function<Result<ExtensionStep>(const ExtensionChange& change, const Find& find)>;
  std::map<std::string, Check> verbs = {};
  /// What follows when something is renamed; its inverse is that of the renaming.
  std::function<ExtensionStep(const std::string& from, const std::string& to)> rename = {};
  /// Whether somebody has offered this very port.
  std::function<bool(const Port& port)> is_offered = {};
};

/// Who keeps paths, as rules do, is told when something gets another name, and when that is taken back. Kept with the root
/// of the tree.
///
/// Threads: under the structure lock.
struct PathFollowers final : Annotation {
  /// Has a path, or the paths in a text, lead where it has led before.
  using Move = std::function<void(std::string& path)>;
  std::vector<std::function<void(const Move& move)>> all = {};
};

/// Who knows what rules, or a replay, have switched for the time being, which a file that is saved does not get. Kept with
/// the root of the tree.
///
/// Threads: under the structure lock.
struct SwitchedByRules final : Annotation {
  /// Each of these takes back what one of them has connected and cut; the last one first.
  std::vector<std::function<std::vector<ChangeSet>()>> all = {};
};

}  // namespace runnel
