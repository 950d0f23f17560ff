#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/element/configurable.h"
#include "core/element/runtime.h"
#include "core/element/unlisted_element.h"
#include "core/plugin/module_registry.h"
#include "plugins/structure/change.h"
#include "plugins/structure/inverse.h"
#include "plugins/structure/module_values.h"
#include "plugins/structure/replacement.h"
#include "plugins/structure/structure_overlay.h"

namespace runnel {
class GroupParameter;
}

namespace runnel::internal {

/// Errors: who has made the element, or one in it, is no change (NotSaved); it cannot be `what`.
Result<void> CheckIsNotOfTags(const FrameworkElement& element, const char* what);

/// A module that has made room for another one.
struct Replaced {
  UnlistedElement before;
  std::string path;
  std::uint64_t id = 0;  // of the new module
  std::uint64_t probation_cycles = 0;
  const FrameworkElement* after = nullptr;
  ParameterRecords began = {};  // of that
};

/// What one change set makes beside the tree, by what it is and where it goes: kept from one attempt to the next, as
/// others may change the structure while a slow module is made, and it is to be made once.
///
/// Threads: one.
class Workshop {
 public:
  struct Work {
    std::shared_ptr<UnlistedElement> element;
    ParameterRecords began = {};  // of the module whose place it takes, when it was made
  };
  /// Thrown when others have changed the structure meanwhile: the attempt is to begin anew.
  struct Overtaken {};

  /// What has been made for `key`, or what `make` makes.
  const Result<Work>& Get(const std::string& key, const std::function<Result<Work>()>& make) {
    // Its place is there before it is, so that it is not destroyed again for lack of one, under the structure lock.
    const auto [work, is_new] = works_.try_emplace(key, Error{});
    if (!is_new) return work->second;
    try {
      work->second = make();
    } catch (...) {
      works_.erase(work);
      throw;
    }
    return work->second;
  }
  [[nodiscard]] std::size_t size() const noexcept { return works_.size(); }

 private:
  std::map<std::string, Result<Work>> works_;  // a group comes before what is in it: it is asked for first
};

/// While one lives, the thread that holds the structure lock does not. Precondition: it has taken it once.
class Unlocked {
 public:
  explicit Unlocked(Runtime& runtime) : mutex_(runtime.structure_mutex()) { mutex_.unlock(); }
  ~Unlocked() { mutex_.lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  OrderedMutex& mutex_;
};

/// Made beside the tree, until it is listed.
using New = std::shared_ptr<UnlistedElement>;

/// The connections between what is at or below `element` and the rest. Under the structure lock.
[[nodiscard]] std::vector<Connection> ExternalConnectionsOf(FrameworkElement& element);

/// nullptr if it is the last.
[[nodiscard]] const FrameworkElement* NextSibling(const FrameworkElement& element);

/// What takes a step back succeeds, but for lack of memory; then it is tried again.
void Must(const auto& outcome) {
  if (!outcome) throw ElementError(outcome.error());
}

/// A change set that has been checked against the structure, with everything made that it needs: all that
/// is left is to carry it out, between two cycles, and quickly.
///
/// Threads:  under the structure lock, taken once, from Make() to Commit().
class Plan {
 public:
  /// `workshop` has what attempts before have made, and outlives it. `is_way_back`: of what an undo or a redo changes.
  Plan(Runtime& runtime, const ModuleRegistry& modules, Workshop& workshop, bool is_way_back)
      : runtime_(runtime), modules_(modules), workshop_(workshop), is_way_back_(is_way_back), overlay_(runtime) {}
  /// Outside of cycles and without the structure lock: waits until no thread can see any more what has been in
  /// the tree and is destroyed now.
  ~Plan();

  /// Checks the changes one after the other, each as if those before had been made, and makes what is
  /// new, beside the tree. All that is wrong goes to `diagnostics`, at `places`, if there are any. Lets go of the
  /// structure lock while it makes a module; throws Workshop::Overtaken if others have changed something then.
  void Make(const ChangeSet& changes, const std::vector<SourcePosition>& places, Diagnostics& diagnostics);

  /// Carries it out. `back`, if there is one, gets what would take it back. Errors: what could not be foreseen,
  /// whatever was thrown; nothing has changed then.
  Result<void> Commit(UndoRecord* back);

  /// The elements whose threads shall stand between two cycles meanwhile.
  [[nodiscard]] const std::vector<std::string>& concerned() const noexcept { return concerned_; }
  /// Those of them that no thread may be within, not even one that does not return: they go.
  [[nodiscard]] const std::vector<std::string>& going() const noexcept { return going_; }
  /// After Commit(): what is out of the tree now, and is to be destroyed.
  [[nodiscard]] std::vector<UnlistedElement>& removed() noexcept { return removed_; }
  [[nodiscard]] std::vector<Replaced>& replaced() noexcept { return replaced_; }
  /// And which values what comes back has to do without.
  [[nodiscard]] const std::vector<Error>& refused() const noexcept { return refused_; }

 private:
  // Undo is called if this step or a later one has failed, and again if it throws itself; it finds out how far
  // apply, or an earlier undo, has come. None of them waits for anything.
  struct Step {
    std::function<Result<void>()> apply;
    std::function<void()> undo;
    // What would take it back, asked right before it is applied; nothing where another step's does.
    std::function<ChangeSet(std::optional<Error>& why_not)> inverse = [](auto&) { return ChangeSet(); };
  };

  Result<void> CheckEach(const ChangeSet& changes);
  Result<void> Check(const CreateModule& change);
  Result<void> Check(const CreateGroup& change);
  Result<void> Check(const CreatePort& change);
  Result<void> Check(const CreateParameter& change);
  Result<void> Check(const DeleteElement& change);
  Result<void> Check(const ConnectPorts& change) {
    return is_way_back_ ? TieAgain(change) : CheckTie(change.from, change.to, change.options);
  }
  Result<void> Check(const DisconnectPorts& change) { return CheckTie(change.from, change.to, std::nullopt); }
  Result<void> Check(const SetParameter& change);
  Result<void> Check(const ReplaceModule& change) { return CheckReplacement(change, Misfits::kAreRefused); }
  Result<void> Check(const AssignToThread& change);
  Result<void> Check(const AddThread& change);
  Result<void> Check(const ScheduleThread& change);
  Result<void> Check(const RenameElement& change);
  Result<void> Check(const CopyElement& change);
  Result<void> Check(const TagElement& change);
  Result<void> Check(const LogElement& change);
  Result<void> Check(const ExtensionChange& change);

  // What becomes of connections that a module which takes another one's place has no port for.
  enum class Misfits { kAreRefused, kAreCut };
  Result<void> CheckReplacement(const ReplaceModule& change, Misfits misfits);
  // By a module at `place`, beside the tree, which may be another one than that of `before`.
  Result<void> CheckReplacement(FrameworkElement& before, const Placement& place, const ReplaceModule& change,
                                Misfits misfits);
  // In the group `parent`, under another name or the same.
  Result<void> MoveTo(const Placement& place, FrameworkElement& element);
  Result<void> MoveGroup(const Placement& place, FrameworkElement& group);
  Result<void> MovePort(const Placement& place, Port& port);
  void AddInheritance(FrameworkElement& made, const FrameworkElement& before);
  // What else names it by its path.
  void MoveTargets(const FrameworkElement& renamed, const std::string& name);
  // By then.
  [[nodiscard]] const std::vector<std::string>& TargetsOf(const GroupParameter& parameter) const;
  void MoveExtensions(const FrameworkElement& renamed, const std::string& name);
  Result<void> CheckAll(const GroupParameter& group, const SetParameter& change);
  Result<void> CheckStatic(const FrameworkElement& element, const Configurable& parameter, const void* value);
  Result<void> Cut(const std::vector<std::pair<Port*, Port*>>& misfits, const FrameworkElement& module);

  // One that is to be when its ends are there, and at least one is not; or that has been to be until now.
  Result<void> CheckLateTie(const std::string& from, const std::string& to,
                            const std::optional<ConnectOptions>& wanted);
  // One that has been before: it waits where its ends are there and do not fit, as it did then.
  Result<void> TieAgain(const ConnectPorts& tie);
  // `wanted`: of the connection that is to be; nullopt: none is to be.
  Result<void> CheckTie(const std::string& from_path, const std::string& to_path,
                        const std::optional<ConnectOptions>& wanted);
  // `stays_cut`: once its ends are there again, too.
  Result<void> CheckTie(Port& from, Port& to, const std::optional<ConnectOptions>& wanted, bool stays_cut = true);
  Result<void> Apply(UndoRecord* back, std::size_t& begun);
  // Constructed, configured, with what had been set at `before`, if there is one, and prepared.
  Result<Workshop::Work> MakeModule(const Placement& place, const ReplaceModule& change,
                                    const FrameworkElement* before);
  Result<Workshop::Work> MakeGroup(const Placement& place, const FrameworkElement* before, const GivenState& state);
  // By what `key` is distinguished among what goes there.
  std::string KeyOf(const Placement& place, std::string key, const FrameworkElement* before);
  void WarnOfMissingSources(Diagnostics& diagnostics) const;

  // Prepares what has just been made, with what had been set at another one, and adds it.
  Result<void> AddNew(UnlistedElement made, const GivenState& state = {});
  // Behind `sibling`; without, after all.
  void AddCreation(New element, const FrameworkElement* sibling = nullptr, GivenState state = {});
  void AddRemoval(FrameworkElement& element);
  void AddReplacement(FrameworkElement& before, const Workshop::Work& work, std::vector<std::pair<Port*, Port*>> ports,
                      const ReplaceModule& change);
  // Has `set` set what is wanted instead of what `get` finds then, and that again if need be.
  template <typename Get, typename Set, typename Inverse>
  void AddSetting(Get get, Set set, std::invoke_result_t<Get> wanted, Inverse inverse) {
    auto before = std::make_shared<std::optional<std::invoke_result_t<Get>>>();
    steps_.push_back({[=]() -> Result<void> {
                        *before = get();
                        return set(wanted);
                      },
                      [=] {
                        if (*before) (void)set(**before);  // it has been good before
                      },
                      std::move(inverse)});
  }
  // The module that a port or parameter belongs to, or the group.
  void Concern(const FrameworkElement& element);

  Runtime& runtime_;
  const ModuleRegistry& modules_;
  Workshop& workshop_;
  const bool is_way_back_;
  std::map<std::string, int> keys_;  // of what has been asked of it, and how often
  StructureOverlay overlay_;
  std::map<const GroupParameter*, std::vector<std::string>> targets_;  // that have got other names
  std::vector<Step> steps_;
  bool has_failed_ = false;  // in carrying it out, so that others may have seen what is new
  std::vector<std::string> concerned_;
  std::vector<std::string> going_;
  std::vector<FrameworkElement*> made_;
  std::vector<Error> further_errors_;  // of a change that has more than one
  std::vector<Error> warnings_;
  std::vector<Error> refused_;
  std::vector<UnlistedElement> removed_;
  std::vector<Replaced> replaced_;
  std::vector<BeforeHandOver::Held> held_;  // during Commit()
};

}  // namespace runnel::internal
