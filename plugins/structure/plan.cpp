#include "plugins/structure/plan.h"

#include <algorithm>
#include <new>

#include "core/base/retry.h"
#include "core/element/attempt.h"
#include "core/lockfree/thread_epoch.h"
#include "core/module/group.h"
#include "core/paths/late_connections.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/renamed_text.h"

namespace runnel::internal {

const FrameworkElement* NextSibling(const FrameworkElement& element) {
  const auto& siblings = element.parent()->children();
  const auto next = std::next(std::ranges::find(siblings, &element));
  return next == siblings.end() ? nullptr : *next;
}

std::vector<Connection> ExternalConnectionsOf(FrameworkElement& element) {
  std::vector<Connection> ties;
  element.VisitAll<Port>([&](Port& port) {
    for (const Connection& edge : port.outgoing()) {
      if (!edge.to->IsAtOrBelow(element)) ties.push_back(edge);
    }
    for (Port* from : port.incoming()) {
      if (!from->IsAtOrBelow(element)) ties.push_back({from, &port, from->OptionsTo(port)});
    }
  });
  return ties;
}

void Plan::Make(const ChangeSet& changes, const std::vector<SourcePosition>& places, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto tell = [&](Error error) {
      if (i < places.size() && !places[i].file.empty()) error.position = places[i];
      diagnostics.Add(std::move(error));
    };
    try {
      const auto check = [this](const auto& change) { return Check(change); };
      if (const auto possible = std::visit(check, changes[i]); !possible) tell(possible.error());
    } catch (const Workshop::Overtaken&) {
      throw;
    } catch (const std::bad_alloc&) {  // nothing is wrong with the change
      throw;
    } catch (...) {  // the projection may have been told of something that is gone again
      return tell({.message = DescribeException()});
    }
    for (Error& each : further_errors_) tell(std::move(each));
    further_errors_.clear();
  }
  for (Error& each : warnings_) diagnostics.AddWarning(std::move(each));
  if (diagnostics.ok()) WarnOfMissingSources(diagnostics);
}

Result<void> Plan::CheckEach(const ChangeSet& changes) {
  for (const Change& each : changes) {
    if (auto good = std::visit([this](const auto& change) { return Check(change); }, each); !good) return good;
  }
  return {};
}

Plan::~Plan() {
  const auto is_left = [](const Replaced& each) { return bool(each.before); };
  if (has_failed_ || !removed_.empty() || std::ranges::any_of(replaced_, is_left)) WaitForReaders();
}

Result<void> Plan::Commit(UndoRecord* back) {
  const ChangeScope all_at_once(runtime_);
  has_failed_ = true;  // until it has not
  std::size_t begun = 0;
  const Result<void> result = Attempt([&] { return Apply(back, begun); });
  has_failed_ = !result;
  bool is_undone = true;
  while (has_failed_ && begun > 0) is_undone = Retry(steps_[--begun].undo) && is_undone;
  held_.clear();
  if (is_undone) return result;
  Error error = result.error();
  error.message += "; and what had been done before could not be taken back for lack of memory";
  return error;
}

Result<void> Plan::Apply(UndoRecord* back, std::size_t& begun) {
  std::vector<ChangeSet> inverses;
  std::optional<Error> why_not;
  for (const Step& step : steps_) {
    if (back != nullptr) inverses.push_back(step.inverse(why_not));
    ++begun;
    if (auto applied = step.apply(); !applied) return applied;
  }
  for (Replaced& each : replaced_) {
    if (each.probation_cycles > 0) each.began = RecordsOf(*each.after);
  }
  if (back != nullptr) *back = UndoRecordOf(inverses, std::move(why_not), runtime_.root());
  return {};
}

void Plan::Concern(const FrameworkElement& element) {
  const FrameworkElement* module = &element;
  while (module->parent() != nullptr && module->kind() != ElementKind::kModule &&
         module->kind() != ElementKind::kGroup) {
    module = module->parent();
  }
  // Ports of a group's interface: whoever is at their far ends.
  if (const auto* const port = dynamic_cast<const Port*>(&element); port && port->is_proxy()) {
    for (const Port* end : port->Sources()) Concern(*end);
    for (const Port* end : port->Sinks()) Concern(*end);
    return;
  }
  if (std::ranges::find(concerned_, module->path()) == concerned_.end()) {
    concerned_.push_back(module->path());
  }
}

void Plan::WarnOfMissingSources(Diagnostics& diagnostics) const {
  for (FrameworkElement* each : made_) {
    each->VisitAll<const Port>([&](const Port& port) {
      if (!port.is_required() || overlay_.HasSource(port) || LateConnections::Awaits(port)) return;
      diagnostics.AddWarning({.message = "is required, and nothing is connected to it", .path = port.path()});
    });
  }
}

void Plan::AddCreation(New kept, const FrameworkElement* sibling, GivenState state) {
  FrameworkElement& made = **kept;
  overlay_.Add(made);
  made_.push_back(&made);
  steps_.push_back({[this, kept, sibling, state = std::move(state)]() -> Result<void> {
                      if (state) {
                        if (auto given = state->GivePorts(**kept); !given) return given;
                      }
                      const FrameworkElement* const place = sibling != nullptr ? NextSibling(*sibling) : nullptr;
                      const auto listed = runtime_.List(std::move(*kept), place);
                      return listed ? Result<void>() : listed.error();
                    },
                    [this, kept, &made] {
                      if (!*kept) *kept = runtime_.Unlist(made).value();
                    },
                    [&made](auto&) -> ChangeSet { return {DeleteElement{made.path()}}; }});
}

// What goes with it stays as it is among itself; what ties it to others is cut.
void Plan::AddRemoval(FrameworkElement& element) {
  struct Done {
    std::vector<Connection> ties;
    std::size_t cut = 0;  // of the ties
    const FrameworkElement* place = nullptr;
    bool is_removed = false;
  };
  auto done = std::make_shared<Done>();
  steps_.push_back({[=, this, &element]() -> Result<void> {
                      done->ties = ExternalConnectionsOf(element);
                      removed_.reserve(removed_.size() + 1);
                      for (const Connection& tie : done->ties) {
                        if (auto cut = Port::Disconnect(*tie.from, *tie.to); !cut) return cut;
                        ++done->cut;
                      }
                      done->place = NextSibling(element);
                      auto taken = runtime_.Unlist(element);
                      if (!taken) return taken.error();
                      removed_.push_back(std::move(*taken));
                      done->is_removed = true;
                      return {};
                    },
                    [=, this] {
                      if (done->is_removed) {
                        Must(runtime_.List(std::move(removed_.back()), done->place));
                        removed_.pop_back();
                        done->is_removed = false;
                      }
                      for (; done->cut > 0; --done->cut) {
                        const Connection& tie = done->ties[done->cut - 1];
                        Must(Port::Connect(*tie.from, *tie.to, tie.options));
                      }
                    },
                    [&element](auto& why_not) { return MakeAgain(element, why_not); }});
}

void Plan::AddReplacement(FrameworkElement& before, const Workshop::Work& work,
                          std::vector<std::pair<Port*, Port*>> ports, const ReplaceModule& change) {
  struct Done {
    New after;                                // until it is listed
    UnlistedElement before;                   // once it is not
    const FrameworkElement* place = nullptr;  // of `before`
    std::size_t moved = 0;                    // of the ports
    bool is_noted = false;
    GivenParameters records;  // that take it back, if anything will
  };
  Concern(before);
  going_.push_back(before.path());
  FrameworkElement& next = **work.element;
  auto done = std::make_shared<Done>();
  done->after = work.element;
  steps_.push_back({[=, this, &before, &next, began = work.began]() -> Result<void> {
                      // What has been set or assigned since the new module was made, by this change set or others.
                      auto refused = CopyValues(before, began, &change, next);
                      if (change.parameters == nullptr && !refused.empty()) return refused.front();
                      for (Error& each : refused) {
                        each.message = "its value is not taken over: " + each.message;
                        refused_.push_back(std::move(each));
                      }
                      if (done->records != nullptr) NoteLeft(done->records, next);
                      InheritAnnotations(next, before, ports);
                      if (change.state) {
                        if (auto given = change.state->GivePorts(next, ports); !given) return given;
                      }
                      for (const auto* each : {&before, &next}) {
                        if (auto settled = Settle(*each, held_); !settled) return settled;
                      }
                      if (auto copied = CopyState(before, next); !copied) return copied;
                      Replaced replaced{{}, next.path(), next.id(), change.probation_cycles, &next};
                      replaced_.reserve(replaced_.size() + 1);
                      done->place = NextSibling(before);
                      auto taken = runtime_.Unlist(before);
                      if (!taken) return taken.error();
                      done->before = std::move(*taken);
                      for (const auto& [from, to] : ports) {
                        TakeOver(*to, *from, before, next);
                        ++done->moved;
                      }
                      const bool is_same_place = next.parent() == before.parent();
                      if (auto listed = runtime_.List(std::move(*done->after), is_same_place ? done->place : nullptr);
                          !listed) {
                        return listed.error();
                      }
                      replaced.before = std::move(done->before);
                      replaced_.push_back(std::move(replaced));
                      done->is_noted = true;
                      return {};
                    },
                    [=, this, &before, &next] {
                      if (done->is_noted) {
                        done->before = std::move(replaced_.back().before);
                        replaced_.pop_back();
                        done->is_noted = false;
                      }
                      if (!done->before) return;
                      if (!*done->after) {
                        if (next.parent() == before.parent()) done->place = NextSibling(next);
                        *done->after = runtime_.Unlist(next).value();
                      }
                      for (; done->moved > 0; --done->moved) {
                        const auto& [from, to] = ports[done->moved - 1];
                        TakeOver(*from, *to, next, before);
                      }
                      Must(runtime_.List(std::move(done->before), done->place));
                    },
                    [=, &before, &next](auto& why_not) {
                      ChangeSet back = ReplaceBack(before, next, change, why_not);
                      if (!back.empty()) done->records = std::get<ReplaceModule>(back.front()).parameters;
                      return back;
                    }});
}

// What is new, made beside the tree.

std::string Plan::KeyOf(const Placement& place, std::string key, const FrameworkElement* before) {
  key += " " + std::to_string(place.parent.id()) + "/" + place.name;
  if (before != nullptr) key += " " + std::to_string(before->id());
  return key + " " + std::to_string(keys_[key]++);
}

Result<Workshop::Work> Plan::MakeModule(const Placement& place, const ReplaceModule& change,
                                        const FrameworkElement* before) {
  std::string key = change.type;
  for (const Setting& each : change.settings) key += " " + each.parameter + "=" + each.value;
  // Whatever is to be known of others is looked at first: they may go while it is made.
  const std::uint64_t revision = runtime_.revision_by_others();
  const auto& work = workshop_.Get(KeyOf(place, std::move(key), before), [&]() -> Result<Workshop::Work> {
    ParameterRecords began, records;
    std::optional<ElementState> state;
    std::string name = place.name;
    if (before != nullptr) {
      began = RecordsOf(*before);
      records = change.parameters != nullptr ? RecordsOf(*before, change.parameters) : began;
      state.emplace(*before, FrameworkElement::Inherit::kAsReplacement, ElementState::Below::kIncluded);
      name = NameInFile::Of(*before);
    }
    const Unlocked unlocked(runtime_);
    auto made = modules_.Make(change.type, place);
    if (!made) return made.error().WithPath(place.parent.path() + "/" + place.name);
    if (auto set = ConfigureNew(**made, records, change.settings); !set) return set.error();
    if (change.state) change.state->GiveAnnotations(**made);
    if (state) state->GiveAnnotations(**made);
    if (name != place.name) (*made)->Annotate(std::make_unique<NameInFile>(name));
    if (auto prepared = Runtime::Prepare(*made); !prepared) return prepared.error();
    return Workshop::Work{std::make_shared<UnlistedElement>(std::move(*made)), std::move(began)};
  });
  if (runtime_.revision_by_others() != revision) throw Workshop::Overtaken();
  return work;
}

Result<Workshop::Work> Plan::MakeGroup(const Placement& place, const FrameworkElement* before,
                                       const GivenState& state) {
  return workshop_.Get(KeyOf(place, "group", before), [&]() -> Result<Workshop::Work> {
    auto made = std::make_shared<UnlistedElement>(std::make_unique<Group>(place));
    if (state) state->GiveAnnotations(**made);
    if (before != nullptr) NameInFile::Note(**made, *before);
    if (auto prepared = Runtime::Prepare(*made); !prepared) return prepared.error();
    return Workshop::Work{std::move(made)};
  });
}

Result<void> Plan::AddNew(UnlistedElement made, const GivenState& state) {
  if (state) state->GiveAnnotations(*made);
  if (auto prepared = Runtime::Prepare(made); !prepared) return prepared;
  AddCreation(std::make_shared<UnlistedElement>(std::move(made)), nullptr, state);
  return {};
}

}  // namespace runnel::internal
