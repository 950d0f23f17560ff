#include <map>
#include <string>

#include "core/element/file_notes.h"
#include "core/log/log_level.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/part_files.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

using internal::FileUpdate;
using internal::Saving;

void ReadLog(const TagUse& use) {
  const XmlAttribute* const of = use.Find("of");
  const FrameworkElement* const subtree =
      of != nullptr ? SearchElement(PathIn(*of, use.parent), use.context) : &use.parent;
  if (subtree == nullptr) return;
  SetLogLevel(use.context.runtime(), subtree->path(), LogLevelOf(use.Get("level").value).value());
}

/// What is set of the application and what is in it, as one saving has it written.
struct SavedLevels {
  struct Said {
    XmlElement tag;
    FileUpdate* update;
  };
  std::map<std::string, std::string> wanted;  ///< levels by paths
  std::map<std::string, Said> said;           ///< by which tag; of several the last, which counts
  bool are_read = false;
  bool are_compared = false;
};

// What is set for everything holds for the application, if that has nothing of its own.
SavedLevels& LevelsOf(Saving& saving) {
  auto& levels = saving.Note<SavedLevels>();
  if (std::exchange(levels.are_read, true)) return levels;
  FrameworkElement& application = saving.application;
  for (const auto& [path, level] : ReadLogLevels(application.runtime())) {
    if (path.empty()) levels.wanted[application.path()] = LogLevelName(level);
    const auto found = application.runtime().root().Find(path);
    if (found && (*found)->IsAtOrBelow(application)) levels.wanted[path] = LogLevelName(level);
  }
  return levels;
}

void UpdateLog(XmlElement tag, FrameworkElement& parent, FileUpdate& update) {
  const XmlAttribute* const of = tag.Attribute("of");
  const PathUse use = of != nullptr ? PathIn(*of, parent) : PathUse{parent, ".", {}};
  const auto found = PathSearch(use.base).Find(use.path);
  SavedLevels& levels = LevelsOf(update.saving());
  if (!found || !levels.wanted.contains((*found)->path())) return update.editor().Remove(tag);
  levels.said.insert_or_assign((*found)->path(), SavedLevels::Said{tag, &update});
}

// Where the file says it: in the innermost group whose inside is its own.
FrameworkElement& HomeOf(FrameworkElement& element, FrameworkElement& application) {
  FrameworkElement* home = &element;
  for (FrameworkElement* at = &element; at != &application; at = at->parent()) {
    const bool is_own =
        at->kind() == ElementKind::kGroup && !IsModule(*at) && at->FindAnnotation<PartInstance>() == nullptr;
    if (!is_own) home = at->parent();
  }
  return *home;
}

// Where the file and what is differ; only a tag of the application's own file can be changed.
void Compare(SavedLevels& levels, const FileUpdate* own) {
  for (const auto& [path, said] : levels.said) {
    const auto wanted = levels.wanted.find(path);
    const bool is_same = said.tag.Attribute("level")->value == wanted->second;
    if (!is_same && said.update != own) continue;
    if (!is_same) said.update->editor().SetAttribute(said.tag, "level", wanted->second);
    levels.wanted.erase(wanted);
  }
}

bool IsMadeByOthers(const FrameworkElement& element, const FrameworkElement& application) {
  for (const FrameworkElement* at = &element; at != &application; at = at->parent()) {
    if (at->FindAnnotation<NotSaved>() != nullptr || internal::HoldsOnlyThreads(*at)) return true;
  }
  return false;
}

std::vector<NewElement> MissingLevels(const XmlElement*, FrameworkElement& home, Saving& saving, FileUpdate* update) {
  SavedLevels& levels = LevelsOf(saving);
  // All tags are known now, and the first that is asked is the application.
  if (!std::exchange(levels.are_compared, true)) Compare(levels, update);
  std::vector<NewElement> elements;
  for (const auto& [path, level] : levels.wanted) {
    FrameworkElement& element = **home.runtime().root().Find(path);
    if (IsMadeByOthers(element, saving.application)) continue;
    if (&HomeOf(element, saving.application) != &home) continue;
    NewElement& made = elements.emplace_back(NewElement{.name = "log", .attributes = {{"level", level}}});
    if (&element != &home) made.attributes.emplace_back("of", path.substr(home.path().size() + 1));
  }
  return elements;
}

}  // namespace

XmlTag LogTag() {
  return {.name = "log",
          .summary = "what modules say is logged from this level on",
          .parents = {"application", "group"},
          .attributes = {WordRule("level", {LogLevelNames().begin(), LogLevelNames().end()},
                                  "the least that is logged; info if nothing is said", true),
                         PathRule("of", false, "the module or group, with all below it; the one around if left out")},
          .handle = internal::ReadAt<BuildStage::kChecks, ReadLog>,
          .update = UpdateLog,
          .missing = MissingLevels,
          .place = 5};
}

}  // namespace runnel
