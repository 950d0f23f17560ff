// What is new, made beside the tree.

#include <memory>
#include <optional>
#include <utility>

#include "core/module/group.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/module_values.h"
#include "plugins/structure/name_in_file.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/replacement.h"

namespace runnel::internal {

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
